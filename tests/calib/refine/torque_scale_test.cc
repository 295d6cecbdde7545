// Torque constants that are off, each joint's by a factor of its own, move what
// is estimated by as much as `torque_constants_stddev` says: in repeated
// experiments errors have the covariance that is claimed.

#include <gtest/gtest.h>

#include "calib/linear/calibrate_linear.h"
#include "calib/refine/nonlinear_calibration.h"
#include "tests/fixtures/nonlinear_runs.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::torque_scale_test {

constexpr double kTrust = .2;
constexpr int kRuns = 16;
constexpr double kStddev = .03;

// 12 s at 250 Hz with torque noise of .3 %, all torques of joint j 1 + e_j
// times what they were, e_j of this standard deviation.
Log Record(const Robot& truth, std::mt19937_64* random,
           double scale_stddev = kStddev) {
  Log log =
      RecordMotion(RandomMultisine(random, truth.num_joints(), 1.2), 12, .004);
  AddTorque(truth, &log);
  for (int j = 0; j < truth.num_joints(); ++j) {
    log.tau.col(j).array() += truth.links[j].joint.offset;
  }
  AddNoise(random, .003 * ColumnRms(log.tau), &log.tau);
  if (scale_stddev == 0) return log;
  std::normal_distribution<double> scale(1, scale_stddev);
  for (int j = 0; j < truth.num_joints(); ++j) log.tau.col(j) *= scale(*random);
  return log;
}

struct Errors {
  void Add(double error, double stddev) {
    if (!(stddev > 0) || !std::isfinite(stddev)) return;
    squares += error * error / (stddev * stddev);
    ++count;
  }
  double rms() const { return std::sqrt(squares / std::max(1, count)); }
  double squares = 0;
  int count = 0;
};

// Of model parameters and of the robot's for a simulator, where the logs tell
// them.
void Repeat(std::optional<double> claimed, Errors* linear_errors,
            Errors* refined_errors) {
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937_64 random(700 + run);
    const SimulatedArm arm = MakeArm("SCARA RRPR", kTrust, &random);
    LogReaderOptions reader;
    reader.joint_names = arm.file.JointNames();
    reader.torque_constants_stddev = claimed;
    const LogSet log({WriteFile(LogCsv(Record(arm.truth, &random)))}, reader,
                     {});
    NonlinearCalibrationOptions options;
    options.trust.inertia = kTrust;
    LinearCalibrationOptions equations;
    equations.joint_terms = {JointTerm::kViscous, JointTerm::kOffset,
                             JointTerm::kArmature};
    const auto linear = CalibrateLinear(arm.file, equations, log, nullptr);
    ASSERT_TRUE(linear.solved) << linear.reason;
    const Eigen::VectorXd x = linear.parameters.Values(arm.truth);
    for (int k = 0; k < x.size(); ++k) {
      linear_errors->Add(linear.x[k] - x[k], linear.stddev[k]);
    }
    const auto refined =
        CalibrateNonlinear(arm.file, linear, options, log, nullptr);
    for (const PhysicalParameter& p : refined.parameters) {
      if (p.held || !p.identifiable) continue;
      refined_errors->Add(p.value - ValueIn(arm.truth, p.name), p.stddev);
    }
  }
}

TEST(TorqueScale, ErrorsAreAsLargeAsClaimed) {
  Errors linear, refined;
  Repeat(kStddev, &linear, &refined);
  EXPECT_NEAR(linear.rms(), 1, .2);
  EXPECT_NEAR(refined.rms(), 1, .2);
}

TEST(TorqueScale, TakenAsExactTheyAreMuchLarger) {
  Errors linear, refined;
  Repeat(0, &linear, &refined);
  EXPECT_GT(linear.rms(), 3);
  EXPECT_GT(refined.rms(), 2);
}

// A motor of constant K behind a gear of ratio N has the current of its voltage
// less its back-EMF, over the winding's resistance R:
//   u = R / (N K) tau + N K qd
// (Siciliano et al. 2009, 5.2.1). What is calibrated from the voltages as K / R
// times N of torque per volt is the arm, whose viscous friction is larger by
// (N K)^2 / R.
TEST(TorqueScale, VoltagesAreTorquesButForDamping) {
  constexpr double kConstant = .02, kResistance = 1.2, kRatio = 50;
  constexpr double kEmf = kRatio * kConstant;  // V s/rad at the joint
  Errors errors;
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937_64 random(900 + run);
    SimulatedArm arm = MakeArm("SCARA RRPR", kTrust, &random);
    Log log = Record(arm.truth, &random, 0);
    log.tau = kResistance / kEmf * log.tau + kEmf * log.qd;
    std::string csv = LogCsv(log);
    for (size_t at = 0; (at = csv.find("tau", at)) != std::string::npos;) {
      csv.replace(at, 3, "u");
    }
    LogReaderOptions reader;
    reader.joint_names = arm.file.JointNames();
    reader.torque_constants.assign(4, kConstant / kResistance);
    reader.gear_ratios.assign(4, kRatio);
    const LogSet logs({WriteFile(csv)}, reader, {});
    LinearCalibrationOptions equations;
    equations.joint_terms = {JointTerm::kViscous, JointTerm::kOffset,
                             JointTerm::kArmature};
    const auto linear = CalibrateLinear(arm.file, equations, logs, nullptr);
    ASSERT_TRUE(linear.solved) << linear.reason;
    for (Link& link : arm.truth.links) {
      link.joint.viscous += kEmf * kEmf / kResistance;
    }
    const Eigen::VectorXd x = linear.parameters.Values(arm.truth);
    for (int k = 0; k < x.size(); ++k) {
      errors.Add(linear.x[k] - x[k], linear.stddev[k]);
    }
  }
  EXPECT_NEAR(errors.rms(), 1, .2);
}

}  // namespace armcal::torque_scale_test
