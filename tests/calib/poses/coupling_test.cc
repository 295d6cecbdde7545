// Joint positions that were recorded by other rules than the robot file's: what
// is named of them, and that nothing is where there is no such rule.

#include "calib/poses/coupling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/poses/calibrate_poses.h"
#include "calib/poses/follow.h"
#include "calib/poses/load_moment.h"
#include "calib/poses/verdict.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::coupling_test {

// Joints from 0: the arm's joint `joint` stands at q + k q_by.
struct Rule {
  int joint, by;
  double k;
};

// What a controller would have recorded that follows `rule`.
void Record(const Rule& rule, PoseMeasurements* m) {
  if (rule.joint == rule.by) {
    m->q.col(rule.joint) /= 1 + rule.k;
  } else {
    m->q.col(rule.joint) -= rule.k * m->q.col(rule.by);
  }
}

int Poses(Instrument instrument) {
  return instrument == Instrument::kWire ? 180 : 60;
}

// The elbow counted from the ground, a wrist whose gear turns the next one by a
// hundredth, a wrong gear ratio.
TEST(PoseCoupling, IsNamedWithItsFactor) {
  for (const std::string name : {"PUMA560 6R", "UR5 6R"}) {
    for (const auto instrument :
         {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
      for (const Rule& rule :
           {Rule{2, 1, -1}, Rule{4, 3, .02}, Rule{1, 1, .01}}) {
        SCOPED_TRACE(name + " joint " + std::to_string(rule.joint + 1) +
                     ", instrument " +
                     std::to_string(static_cast<int>(instrument)));
        Plant plant(name, 40);
        auto m = plant.Measure(instrument, Poses(instrument), kNoise);
        Record(rule, &m);
        const auto found = FindCoupling(plant.nominal, m, {});
        // The file's tool is where the PUMA's wrist axes meet, which a wire
        // follows and the wrist does not move.
        if (name == "PUMA560 6R" && instrument == Instrument::kWire &&
            rule.joint == 4) {
          EXPECT_FALSE(found);
          continue;
        }
        ASSERT_TRUE(found);
        EXPECT_EQ(found->joint, rule.joint);
        EXPECT_EQ(found->by, rule.by);
        EXPECT_NEAR(found->factor, rule.k, 3.5 * found->stddev);
        EXPECT_LT(found->stddev, 1e-3);
        EXPECT_LT(found->rms_after, 3 * kNoise);
        EXPECT_GT(std::max(found->rms_before / found->rms_after,
                           found->angle_before / found->angle_after),
                  10);
      }
    }
  }
}

// Few poses move the joint that others follow, and Tukey's loss gives them up:
// all that is left looks perfect.
TEST(PoseCoupling, IsNamedWhereALossGivesUpWhatShowsIt) {
  Plant plant("PUMA560 6R", 3);
  Eigen::VectorXd held = Eigen::VectorXd::Constant(6, std::nan(""));
  held[1] = .3;
  auto m = plant.Measure(Instrument::kTargets, 54, kNoise, held);
  const auto moved = plant.Measure(Instrument::kTargets, 6, kNoise);
  m.q.conservativeResize(60, Eigen::NoChange);
  m.q.bottomRows(6) = moved.q;
  for (int t = 0; t < 3; ++t) {
    m.targets[t].conservativeResize(60, Eigen::NoChange);
    m.targets[t].bottomRows(6) = moved.targets[t];
  }
  m.row.resize(60, 2);
  Record({2, 1, -1}, &m);
  const auto c = CalibratePoses(plant.nominal, m, {});
  ASSERT_TRUE(c.solved) << c.reason;
  EXPECT_LT(c.median, 3 * kNoise);
  ASSERT_TRUE(c.coupling);
  EXPECT_NEAR(c.coupling->factor, -1, 3.5 * c.coupling->stddev);
  EXPECT_LT(c.inlier_motion[1], .01);
  const auto sentences = Shortcomings(plant.nominal, c);
  EXPECT_THAT(sentences, testing::Contains(testing::HasSubstr("coupling: ")));
  EXPECT_THAT(sentences, testing::Contains(testing::HasSubstr(
                             "moves only in poses that are outliers (0.0 %")));
}

// Columns of other joints, other directions, another frame: a relation may make
// up for half of that. What is named leaves what joints err by, 5 mrad each.
TEST(PoseCoupling, IsNotNamedWhereMuchIsLeft) {
  int mistakes = 0;
  for (const std::string name : {"PUMA560 6R", "UR5 6R"}) {
    Plant plant(name, 44);
    for (const auto instrument : {Instrument::kTargets, Instrument::kPoses}) {
      const auto right = plant.Measure(instrument, 40, kNoise);
      for (int i = 0; i < 6; ++i) {
        for (int j = i; j < 6; ++j) {
          auto m = right;
          m.q.col(i).swap(m.q.col(j));
          if (i == j) m.q.col(i) *= -1;
          const auto found = FindCoupling(plant.nominal, m, {});
          ++mistakes;
          if (!found) continue;
          EXPECT_LT(found->rms_after, 5e-3 * std::sqrt(6) * PoseExtent(m))
              << name << " " << i << " " << j;
        }
      }
    }
  }
  EXPECT_EQ(mistakes, 84);
}

// A file that is wrong in its geometry alone, joints that bend under a load,
// and gross errors are no coupling.
TEST(PoseCoupling, IsNotNamedWhereThereIsNone) {
  for (int run = 0; run < 8; ++run) {
    Plant plant(run % 2 ? "PUMA560 6R" : "UR5 6R", 60 + run);
    for (const auto instrument :
         {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
      const auto m = plant.Measure(instrument, Poses(instrument), kNoise);
      EXPECT_FALSE(FindCoupling(plant.nominal, m, {})) << run;
      auto bent = m;  // 2 mrad per metre of lever
      bent.q -= 2e-3 * LoadMoments(plant.robot, m.q);
      EXPECT_FALSE(FindCoupling(plant.nominal, bent, {})) << run;
      auto wrong = m;
      for (auto& target : wrong.targets) target(run, 0) += .3;
      if (wrong.poses.size() > 0) wrong.poses(run, 0) += .3;
      if (wrong.lengths.size() > 0) wrong.lengths[run] += .3;
      EXPECT_FALSE(FindCoupling(plant.nominal, wrong, {})) << run;
    }
  }
}

// Encoders that run eccentrically, by 1 mrad once in a turn, look like a gear
// ratio over half a turn.
TEST(PoseCoupling, IsNotNamedForAnEccentricJoint) {
  for (int joint = 0; joint < 6; ++joint) {
    Plant plant("UR5 6R", 80 + joint);
    auto m = plant.Measure(Instrument::kTargets, 60, kNoise);
    m.q.col(joint).array() -= 1e-3 * m.q.col(joint).array().sin();
    EXPECT_FALSE(FindCoupling(plant.nominal, m, {})) << joint;
  }
}

// What bends is no part of the factor, nor of what is left.
TEST(PoseCoupling, IsNamedBesideSag) {
  Plant plant("PUMA560 6R", 15);
  auto m = plant.Measure(Instrument::kTargets, 60, kNoise);
  m.q -= 5e-3 * LoadMoments(plant.robot, m.q);
  Record({2, 1, -1}, &m);
  const auto found = FindCoupling(plant.nominal, m, {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->factor, -1, 3.5 * found->stddev);
  EXPECT_LT(found->rms_after, 3 * kNoise);
}

// A gear ratio that is wrong by 1.5 % beside errors twice a turn of 20 mrad on
// three joints: it is there, but what is left is larger.
TEST(PoseCoupling, IsNotNamedWhereMoreIsLeft) {
  Plant plant("PUMA560 6R", 8);
  auto m = plant.Measure(Instrument::kTargets, 200, kNoise);
  for (int j = 0; j < 3; ++j) {
    m.q.col(j).array() -= .02 * (2 * m.q.col(j).array()).sin();
  }
  m.q.col(0) /= 1.015;
  EXPECT_FALSE(FindCoupling(plant.nominal, m, {}));
}

// Two joints that were always moved alike cannot be told apart: none is named.
TEST(PoseCoupling, IsNotNamedWhereAnotherJointMayDoIt) {
  Plant plant("PUMA560 6R", 7);
  auto m = plant.Measure(Instrument::kTargets, 60, kNoise);
  for (int k = 0; k < 60; ++k) {
    const Eigen::VectorXd q = m.q.row(k);
    Eigen::VectorXd both = q;
    both[3] = both[1];
    Plant again("PUMA560 6R", 7);
    const auto one = again.Measure(Instrument::kTargets, 1, kNoise, both);
    for (int t = 0; t < 3; ++t) m.targets[t].row(k) = one.targets[t].row(0);
    m.q.row(k) = both;
  }
  Record({2, 1, -.5}, &m);
  EXPECT_FALSE(FindCoupling(plant.nominal, m, {}));
}

// A vertical arm of two links of 1 m: weight at the tip has its horizontal
// distance as lever.
TEST(LoadMoments, AreHorizontalDistances) {
  Robot robot = SampleRobot("2R planar (vertical plane)");
  Eigen::MatrixXd q(1, 2);
  q << .3, .5;
  const Eigen::Vector3d tip = ToolPose(robot, q.row(0)).translation();
  const Eigen::Vector3d elbow = LinkPoses(robot, q.row(0))[0].translation();
  const Eigen::Vector3d down = robot.gravity.normalized();
  const Eigen::MatrixXd m = LoadMoments(robot, q);
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(m(0, 0), z.dot(tip.cross(down)), 1e-12);
  EXPECT_NEAR(m(0, 1), z.dot((tip - elbow).cross(down)), 1e-12);
  EXPECT_GT(std::abs(m(0, 0)), .1);
}

}  // namespace armcal::coupling_test
