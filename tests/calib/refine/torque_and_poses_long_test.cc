// The table of what torques, poses and both together make of simulated arms
// that are 2 mm, 0.2 degrees and 5 % away from their files, and whether the
// intervals are true. ARMCAL_RUNS sets the number of arms (default 24).

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "calib/linear/calibrate_linear.h"
#include "calib/poses/calibrate_poses.h"
#include "calib/poses/calibration.h"
#include "tests/calib/refine/bent_arm.h"

namespace armcal::torque_and_poses_long_test {

struct Rms {
  void Add(double x) { sum += x * x, ++count; }
  double value() const { return std::sqrt(sum / std::max(1, count)); }
  double sum = 0;
  int count = 0;
};

struct Column {
  Rms tool, torque, length, mass;
  std::map<std::string, std::pair<int, int>> covered;  // by parameter

  void Add(const BentArm& arm, const Robot& robot, const Log& unseen) {
    tool.Add(1e3 * ToolError(robot, arm.truth));
    torque.Add(TorqueError(robot, unseen));
  }
  void AddParameters(const BentArm& arm, const NonlinearCalibration& result) {
    for (size_t k = 0; k < result.parameters.size(); ++k) {
      const PhysicalParameter& p = result.parameters[k];
      const double sd = std::sqrt(result.covariance(k, k));
      if (p.name.rfind("instrument", 0) == 0 || !(sd > 0)) continue;
      const double error = p.value - arm.ValueOf(p);
      auto& [inside, all] = covered[p.name];
      inside += std::abs(error) < 1.96 * sd;
      ++all;
      if (p.geometry && p.unit == "m") length.Add(1e3 * error);
      if (p.unit == "kg") mass.Add(100 * error / p.prior);
    }
  }
  void Print(const char* name) const {
    std::printf("%-12s %9.3f %9.3f %9.3f %9.2f", name, tool.value(),
                torque.value(), length.value(), mass.value());
    if (!covered.empty()) {
      std::printf("   coverage %.4f, least %.3f", Coverage(), Least());
    }
    std::printf("\n");
  }
  double Coverage() const {
    double sum = 0;
    for (const auto& [name, c] : covered) sum += double(c.first) / c.second;
    return sum / covered.size();
  }
  double Least() const {
    double least = 1;
    for (const auto& [name, c] : covered) {
      least = std::min(least, double(c.first) / c.second);
    }
    return least;
  }
};

int NumRuns() {
  const char* runs = std::getenv("ARMCAL_RUNS");
  return runs != nullptr ? std::atoi(runs) : 24;
}

TEST(TorqueAndPosesLong, BeatEitherAlone) {
  Column file, torques, poses, both;
  for (int run = 0; run < NumRuns(); ++run) {
    BentArm arm(run % 2 ? "PUMA560 6R" : "UR5 6R", 9000 + run);
    LogReaderOptions reader;
    reader.joint_names = arm.file.JointNames();
    LogSet log({arm.Record(20)}, reader, {});
    const PoseMeasurements measured = arm.Measure(Instrument::kPoses, 30, 2e-4);
    const Log unseen = arm.Move(10, .02);
    const auto linear = CalibrateLinear(arm.file, {}, log, nullptr);
    NonlinearCalibrationOptions options;
    options.trust = {BentArm::kInertia, BentArm::kLength, BentArm::kAngle};
    options.refine = RefineGeometry::kAll;
    const auto of_torques =
        CalibrateNonlinear(arm.file, linear, options, log, nullptr);
    const auto of_both =
        CalibrateNonlinear(arm.file, linear, options, log, nullptr, &measured);
    PoseCalibrationOptions alone;
    alone.prior_length = BentArm::kLength;
    alone.prior_angle = BentArm::kAngle;
    alone.folds = 0;
    const auto of_poses = CalibratePoses(arm.file, measured, alone);
    ASSERT_TRUE(of_torques.converged() && of_both.converged());
    ASSERT_TRUE(of_poses.solved);
    // Who has no torques has no friction: the truth's.
    const auto lend = [&arm](Robot robot) {
      robot.gravity = arm.file.gravity;
      for (int j = 0; j < robot.num_joints(); ++j) {
        robot.links[j].joint = arm.truth.links[j].joint;
      }
      return robot;
    };
    file.Add(arm, lend(arm.file), unseen);
    poses.Add(arm, lend(of_poses.robot), unseen);
    torques.Add(arm, of_torques.robot, unseen);
    both.Add(arm, of_both.robot, unseen);
    torques.AddParameters(arm, of_torques);
    both.AddParameters(arm, of_both);
  }
  std::printf("                tool mm  torque %%  length mm    mass %%\n");
  file.Print("file");
  torques.Print("torques");
  poses.Print("poses");
  both.Print("both");
  EXPECT_LT(both.tool.value(), poses.tool.value());
  EXPECT_LT(both.tool.value(), .2 * torques.tool.value());
  EXPECT_LT(both.torque.value(), .95 * torques.torque.value());
  EXPECT_LT(both.torque.value(), .2 * poses.torque.value());
  for (const Column* column : {&torques, &both}) {
    EXPECT_GT(column->Coverage(), .93);
    EXPECT_LT(column->Coverage(), .97);
  }
}

}  // namespace armcal::torque_and_poses_long_test
