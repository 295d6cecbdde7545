#include "calib/poses/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "calib/poses/calibrate_poses.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::calibration_test {

using Eigen::VectorXd;
using Refine = RefineGeometry;

PoseCalibrationOptions Options(RobustLoss loss, Refine refine = Refine::kAll,
                               int folds = 0) {
  PoseCalibrationOptions options;
  options.loss = loss;
  options.refine = refine;
  options.folds = folds;
  return options;
}

void ExpectFinite(const PoseCalibration& c) {
  for (const double x :
       {c.noise.position, c.noise.rotation, c.before_rms, c.rms, c.inlier_rms,
        c.median, c.max, c.held_out_rms, c.held_out_median}) {
    EXPECT_TRUE(std::isfinite(x)) << c.reason;
  }
  for (const GeometryEstimate& p : c.parameters) {
    EXPECT_TRUE(std::isfinite(p.value)) << p.name;
    EXPECT_TRUE(std::isfinite(p.stddev) && p.stddev > 0) << p.name;
  }
  for (const Link& link : c.robot.links) {
    EXPECT_TRUE((link.X_PF * link.X_ML).matrix().allFinite());
  }
}

// Positions at new poses without noise, only the instrument fitted anew.
double PredictionError(const Robot& robot, Instrument instrument,
                       Plant* plant) {
  const auto fresh = plant->Measure(instrument, 60, 0);
  return CalibratePoses(robot, fresh,
                        Options(RobustLoss::kSquared, Refine::kNothing))
      .rms;
}

TEST(PoseCalibration, PredictsNewPoses) {
  for (const std::string name : {"PUMA560 6R", "UR5 6R"}) {
    for (const Instrument instrument :
         {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
      Plant plant(name, 5);
      const int poses = instrument == Instrument::kWire ? 180 : 60;
      const auto m = plant.Measure(instrument, poses, kNoise);
      const auto c = CalibratePoses(
          plant.nominal, m, Options(RobustLoss::kHuber, Refine::kAll, 6));
      ASSERT_TRUE(c.solved) << c.reason;
      ExpectFinite(c);
      EXPECT_NEAR(c.noise.position, kNoise, .25 * kNoise);
      EXPECT_GT(PredictionError(plant.nominal, instrument, &plant), 5e-4);
      EXPECT_LT(PredictionError(c.robot, instrument, &plant), 2 * kNoise);
      EXPECT_GT(c.before_rms, 5e-4);
      EXPECT_LT(c.rms, 2 * kNoise);
      EXPECT_GT(c.held_out_rms, c.rms);
      EXPECT_LT(c.held_out_rms, 4 * kNoise);
    }
  }
}

// An instrument may lie on its side. The arm then stands in its new file as in
// the old one.
TEST(PoseCalibration, GravityIsTheFiles) {
  Plant plant("UR5 6R", 6);
  plant.X_WB.linear() = RotationFromRpy({M_PI / 2, .1, -.3});
  for (const auto instrument : {Instrument::kTargets, Instrument::kPoses}) {
    const auto c =
        CalibratePoses(plant.nominal, plant.Measure(instrument, 60, kNoise),
                       Options(RobustLoss::kHuber));
    ASSERT_TRUE(c.solved) << c.reason;
    EXPECT_LT((c.robot.gravity - plant.nominal.gravity).norm(), 1e-12);
  }
}

TEST(PoseCalibration, TooFewPosesAreAVerdict) {
  Plant plant("PUMA560 6R", 1);
  const auto three = CalibratePoses(
      plant.nominal, plant.Measure(Instrument::kTargets, 3, kNoise),
      Options(RobustLoss::kHuber));
  EXPECT_FALSE(three.solved);
  EXPECT_THAT(three.reason, testing::HasSubstr("3 different arm positions"));
  ExpectFinite(three);
  const VectorXd q = VectorXd::Constant(6, .3);
  for (const Instrument instrument :
       {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
    for (const int poses : {1, 40}) {
      const auto same = CalibratePoses(
          plant.nominal, plant.Measure(instrument, poses, kNoise, q),
          Options(RobustLoss::kTukey));
      EXPECT_FALSE(same.solved);
      EXPECT_THAT(same.reason, testing::StartsWith("1 arm position gives "));
      ExpectFinite(same);
      EXPECT_TRUE(same.parameters.empty());
    }
  }
}

TEST(PoseCalibration, AJointThatNeverMovesIsNotClaimed) {
  for (int joint = 0; joint < 6; ++joint) {
    Plant plant("UR5 6R", 2);
    VectorXd q = VectorXd::Constant(6, std::nan(""));
    q[joint] = .4;
    const auto c = CalibratePoses(
        plant.nominal, plant.Measure(Instrument::kTargets, 60, kNoise, q),
        Options(RobustLoss::kHuber, Refine::kAll, 6));
    ASSERT_TRUE(c.solved) << c.reason;
    ExpectFinite(c);
    Plant whole("UR5 6R", 2);
    const auto all = CalibratePoses(
        whole.nominal, whole.Measure(Instrument::kTargets, 60, kNoise),
        Options(RobustLoss::kHuber));
    EXPECT_LT(c.parameters.size(), all.parameters.size());
    EXPECT_GT(c.held.size(), all.held.size());
  }
}

// A DH table of shared/data: d a alpha theta in rows.
Robot ReadDhText(const std::string& path) {
  Robot robot;
  robot.dh_convention = DhConvention::kStandard;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  DhParameters dh;
  while (file >> dh.d >> dh.a >> dh.alpha >> dh.theta) {
    robot.links.emplace_back();
    robot.links.back().name = "link" + std::to_string(robot.links.size());
    SetDhPose(dh, DhConvention::kStandard, &robot.links.back());
  }
  return robot;
}

PoseCalibration Real(const std::string& name, RobustLoss loss, Refine refine) {
  const std::string folder = SHARED_DIR "/data/" + name;
  const Robot robot = ReadDhText(folder + "/dh.txt");
  const auto m = ReadPoses(folder + "/poses.csv", robot.JointNames());
  const auto c = CalibratePoses(robot, m, Options(loss, refine, 6));
  EXPECT_TRUE(c.solved) << c.reason;
  ExpectFinite(c);
  std::printf("%s: before %.4f, rms %.4f, median %.4f, held out %.4f mm\n",
              name.c_str(), 1e3 * c.before_rms, 1e3 * c.rms, 1e3 * c.median,
              1e3 * c.held_out_rms);
  std::printf("  %zu outliers, %zu parameters, %zu held\n", c.outliers.size(),
              c.parameters.size(), c.held.size());
  return c;
}

TEST(PoseCalibration, RealRobots) {
  if (!std::filesystem::exists(SHARED_DIR "/data/geo_fanuc_r2000")) {
    GTEST_SKIP() << "no " SHARED_DIR "/data/geo_fanuc_r2000";
  }
  const char fanuc[] = "geo_fanuc_r2000";
  const auto offsets = Real(fanuc, RobustLoss::kSquared, Refine::kOffsets);
  EXPECT_LE(offsets.before_rms, .75e-3);
  EXPECT_LE(offsets.rms, .384e-3);
  const auto all = Real(fanuc, RobustLoss::kSquared, Refine::kAll);
  EXPECT_LE(all.rms, .34e-3);
  EXPECT_GT(all.held_out_rms, 0);
  const auto cable = Real("geo_irb120_cable", RobustLoss::kTukey, Refine::kAll);
  EXPECT_LE(cable.median, .54e-3);
}

}  // namespace armcal::calibration_test
