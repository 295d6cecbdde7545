#include "model/dynamics/recorded_torque.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/effects/effects.h"
#include "model/robot/kinematics.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/two_link_arm.h"

namespace armcal::recorded_torque_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kStep = .004;  // s
constexpr int kSamples = 500;

// A two-link arm whose equations are the textbook's, and its exact motion.
struct TwoLinks {
  TwoLinks() {
    const Trajectory trajectory = arm.Record(kStep, kSamples);
    motion.dt = kStep;
    motion.q = trajectory.q;
    motion.qd = trajectory.qd;
    motion.qdd = trajectory.qdd;
    changed.robot = arm.ToRobot();
  }
  RecordedTorque Recorded() const {
    return {arm.ToRobot(), {2, CoulombTransition()}, motion};
  }
  MatrixXd Change() const { return Recorded().Change(changed); }
  // The textbook's torque along another motion.
  template <typename Motion>
  MatrixXd Textbook(const Motion& at) const {
    MatrixXd tau(kSamples, 2);
    for (int k = 0; k < kSamples; ++k) {
      Vector2d q = motion.q.row(k), qd = motion.qd.row(k),
               qdd = motion.qdd.row(k);
      at(motion.time(k), &q, &qd, &qdd);
      tau.row(k) = arm.Torque(q, qd, qdd);
    }
    return tau;
  }
  MatrixXd Nominal() const {
    return Textbook([](double, Vector2d*, Vector2d*, Vector2d*) {});
  }
  void Apply(const std::string& effect, int joint, const VectorXd& p) {
    const Robot robot = arm.ToRobot();
    FindEffect(effect)->apply({&robot, joint, nullptr}, p, &changed);
  }

  TwoLinkArm arm;
  Motion motion;
  SimulatedRobot changed;
};

double Worst(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST(RecordedTorque, NominalIsTheTextbooks) {
  TwoLinks two;
  two.arm.viscous = 2;
  EXPECT_LT(Worst(two.Recorded().nominal(), two.Nominal()), 1e-12);
  EXPECT_LT(Worst(two.Recorded().load(), two.Nominal() - 2 * two.motion.qd),
            1e-12);
  two.changed.robot = two.arm.ToRobot();
  EXPECT_EQ(two.Change(), MatrixXd::Zero(kSamples, 2));
}

TEST(RecordedTorque, SpringTakesItsTorque) {
  TwoLinks two;
  two.Apply("spring", 1, Vector2d(3, 0));
  MatrixXd expected = MatrixXd::Zero(kSamples, 2);
  expected.col(1) = 3 * two.motion.q.col(1);
  EXPECT_LT(Worst(two.Change(), expected), 1e-12);
}

TEST(RecordedTorque, EncoderOffsetShiftsTheArm) {
  TwoLinks two;
  two.Apply("encoder_offset", 1, VectorXd::Constant(1, .05));
  const MatrixXd expected = two.Textbook([](double, Vector2d* q, Vector2d*,
                                            Vector2d*) { q->y() -= .05; }) -
                            two.Nominal();
  EXPECT_LT(Worst(two.Change(), expected), 1e-10);
}

// A disc off its axis: reading = q + e sin q.
TEST(RecordedTorque, EncoderErrorsChangeVelocities) {
  TwoLinks two;
  const double e = .02;
  two.changed.sensors.push_back({[=](const ArmInstant&, Reading* reading) {
    reading->position[0] += e * std::sin(reading->position[0]);
  }});
  const MatrixXd expected = two.Textbook([=](double, Vector2d* q, Vector2d* qd,
                                             Vector2d* qdd) {
    double x = q->x();
    for (int i = 0; i < 20; ++i) x = q->x() - e * std::sin(x);
    const double slope = 1 + e * std::cos(x);
    const double v = qd->x() / slope;
    *qdd = {(qdd->x() + e * std::sin(x) * v * v) / slope, qdd->y()};
    *q = {x, q->y()};
    *qd = {v, qd->y()};
  }) - two.Nominal();
  const MatrixXd change = two.Change();
  // Differences at the ends are one-sided.
  EXPECT_LT(Worst(change.middleRows(5, kSamples - 10),
                  expected.middleRows(5, kSamples - 10)),
            2e-3 * expected.cwiseAbs().maxCoeff());
}

// stamp = 1.1 t + 0.05 sin t.
TEST(RecordedTorque, ClockScalesTheMotion) {
  TwoLinks two;
  const auto clock = [](double t) { return 1.1 * t + .05 * std::sin(t); };
  two.changed.clock = clock;
  const MatrixXd expected = two.Textbook([&](double stamp, Vector2d*,
                                             Vector2d* qd, Vector2d* qdd) {
    double t = stamp;
    for (int i = 0; i < 50; ++i) t -= (clock(t) - stamp) / 1.1;
    const double rate = 1.1 + .05 * std::cos(t);
    *qdd = rate * rate * *qdd - .05 * std::sin(t) * *qd;
    *qd *= rate;
  }) - two.Nominal();
  EXPECT_LT(Worst(two.Change(), expected),
            1e-4 * expected.cwiseAbs().maxCoeff());
}

// A torque that was made of the stamps grows with their clock's rate as well.
TEST(RecordedTorque, ClockMakesTorques) {
  TwoLinks two;
  two.changed.clock = [](double t) { return 1.02 * t; };
  const MatrixXd recorded = two.Change();
  two.motion.torque_by_rate = MatrixXd::Constant(kSamples, 2, 5);
  EXPECT_LT(Worst(two.Change(), recorded.array() + .1), 1e-9);
}

// A constant force on the tool: virtual work by differences of the tool's
// position.
TEST(RecordedTorque, ForceOnTheToolTakesItsWork) {
  const EffectArm arm("PUMA560 6R", 2);
  SimulatedRobot changed;
  changed.robot = arm.robot;
  const Eigen::Vector3d force(3, -5, 7);
  WrenchLaw law;
  law.attachment = {5, {.1, .02, -.03}};
  law.wrench = [=](const PointInstant&, const double*, double*) {
    return Wrench{Eigen::Vector3d::Zero(), force};
  };
  changed.wrenches = {law};
  const MatrixXd change = arm.Recorded().Change(changed);
  for (int k = 0; k < arm.motion.size(); k += 20) {
    for (int j = 0; j < 6; ++j) {
      const double dq = 1e-6;
      VectorXd ahead = arm.motion.q.row(k), behind = ahead;
      ahead[j] += dq;
      behind[j] -= dq;
      const Eigen::Vector3d moved =
          LinkPoses(arm.robot, ahead)[5] * law.attachment.p_LP -
          LinkPoses(arm.robot, behind)[5] * law.attachment.p_LP;
      EXPECT_NEAR(change(k, j), -force.dot(moved) / (2 * dq), 1e-6);
    }
  }
}

// Dahl's bristle at constant speed from rest: z = 1 - exp(-x / displacement).
TEST(RecordedTorque, StatesFollowTheMotion) {
  TwoLinks two;
  const double v = .5, displacement = .01;
  two.motion.qd.setConstant(v);
  two.motion.q.col(0) = two.motion.q.col(1) =
      VectorXd::LinSpaced(kSamples, 0, v * kStep * (kSamples - 1));
  two.Apply("presliding", 0, Vector2d(4, displacement));
  const VectorXd change = two.Change().col(0);
  for (int k = 0; k < kSamples; ++k) {
    const double z = 1 - std::exp(-two.motion.q(k, 0) / displacement);
    EXPECT_NEAR(change[k], 4 * z, .02) << k;
  }
}

// A heat capacity behind a resistance under constant power; 0.8 N m s/rad at
// 0.5 rad/s are 0.2 W.
TEST(RecordedTorque, FrictionWarmsTheJoint) {
  TwoLinks two;
  two.arm.viscous = .8;
  two.motion.qd.setConstant(.5);
  two.changed.robot = two.arm.ToRobot();
  two.changed.joint_laws.push_back(
      {1, {}, false, [](const ArmInstant& at, const double*, double*) {
         return -at.temperature[1];
       }});
  RecordedTorque recorded = two.Recorded();
  for (const double R : {2., 5., 2.}) {
    two.changed.thermal = {{9, 1}, {3, R}};  // J/K, K/W
    const VectorXd change = recorded.Change(two.changed).col(1);
    for (int k = 0; k < kSamples; ++k) {
      EXPECT_NEAR(change[k], .2 * R * -std::expm1(-k * kStep / (R * 3)), 1e-9);
    }
  }
  // A thermometer knows better.
  const VectorXd read = VectorXd::LinSpaced(kSamples, 20, 30);
  two.motion.temperature.resize(kSamples, 2);
  two.motion.temperature << read, read;
  EXPECT_LT(Worst(two.Change().col(1), read.array() - 20), 1e-12);
}

// The same questions again, and others in between, have the same answers.
TEST(RecordedTorque, RemembersNothingOfOtherQuestions) {
  const EffectArm arm("SCARA RRPR", 2);
  RecordedTorque shared = arm.Recorded();
  for (int round = 0; round < 2; ++round) {
    for (const Effect& effect : Effects()) {
      const int joint = arm.Joints(effect)[0];
      const VectorXd p = arm.Sizes(effect, joint);
      RecordedTorque fresh = arm.Recorded();
      EXPECT_EQ(arm.Change(effect, joint, p, &shared),
                arm.Change(effect, joint, p, &fresh))
          << effect.name;
    }
  }
}

// Two springs on two joints, each alone, with other links, with friction and
// twice, asked for together and one by one.
TEST(RecordedTorque, SetsOfEffectsAreEachAsIfAlone) {
  const EffectArm arm("SCARA RRPR", 2);
  struct Part {
    std::string effect;
    int joint;
    double factor;  // of its sizes
  };
  const std::vector<std::vector<Part>> sets = {
      {{"elasticity", 0, 1}},
      {{"elasticity", 0, 1}, {"stribeck", 1, 1}},
      {{"elasticity", 0, 1}, {"stribeck", 1, 2}},
      {{"elasticity", 0, 1}, {"payload", -1, 1}},
      {{"elasticity", 0, 1}, {"payload", -1, 1}, {"presliding", 0, 1}},
      {{"elasticity", 0, 1.1}},
      {{"elasticity", 0, 1}, {"elasticity", 1, 1}},
      {{"backlash", 0, 1}, {"payload", -1, 1}},
      {{"payload", -1, 1}, {"stribeck", 0, 1}},
      {{"thermal_friction", 0, 1}, {"elasticity", 1, 1}},
      {{"torque_gain", 0, 1}, {"elasticity", 0, 1}}};
  std::vector<SimulatedRobot> changed;
  for (const std::vector<Part>& set : sets) {
    changed.emplace_back();
    changed.back().robot = arm.robot;
    for (const Part& part : set) {
      const Effect* effect = FindEffect(part.effect);
      ASSERT_NE(effect, nullptr) << part.effect;
      VectorXd p = arm.Sizes(*effect, part.joint);
      p[0] *= part.factor;
      effect->apply(arm.Site(part.joint), p, &changed.back());
    }
  }
  RecordedTorque shared = arm.Recorded();
  const auto together = shared.Changes(changed);
  for (size_t i = 0; i < sets.size(); ++i) {
    RecordedTorque fresh = arm.Recorded();
    const auto alone = fresh.Changes({changed[i]})[0];
    for (size_t j = 0; j < alone.size(); ++j) {
      EXPECT_EQ(together[i][j], alone[j]) << "set " << i << ", joint " << j;
    }
  }
  EXPECT_NE(together[0][0], together[1][1]);
}

}  // namespace armcal::recorded_torque_test
