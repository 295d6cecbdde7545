// A torso with two arms and a gripper (data/two_arms): intervals of a
// robot that branches.
#include <gtest/gtest.h>

#include "model/robot_files/robot_reader.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/monte_carlo.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::linear_branches_test {

using Eigen::VectorXd;

TEST(BranchesInNoise, IntervalsCover) {
  const Robot file =
      ReadRobot(std::string(DATA_DIR) + "/two_arms/real.yaml", {});
  const int n = file.num_joints();
  ASSERT_EQ(file.parents, (LinkParents{-1, 0, 1, 2, 3, 0, 5, 6, 7, 8}));
  std::mt19937_64 random(31);
  LinearCalibrationOptions options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kArmature};
  ModelParameters::Options model;
  model.joint_terms = options.joint_terms;
  Robot truth = file;
  SetRandomInertials(&random, &truth);
  Log exact = RecordMotion(RandomMultisine(&random, n), 24, .01);
  AddTorque(truth, &exact);
  const VectorXd sigma = .02 * ColumnRms(exact.tau);
  MonteCarlo result(ModelParameters(file, model).Values(truth));
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    Log log = exact;
    AddNoise(&random, VectorXd::Constant(n, 2e-5), &log.q);
    AddNoise(&random, sigma, &log.tau);
    result.Add(CalibrateLogs(file, {log}, options));
  }
  result.Print("two arms");
  std::printf("  coverage %.1f %%\n", result.coverage());
  EXPECT_GT(result.coverage(), 93);
  EXPECT_LT(result.coverage(), 97);
}

}  // namespace armcal::linear_branches_test
