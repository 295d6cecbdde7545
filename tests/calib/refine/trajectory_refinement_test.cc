#include "calib/refine/trajectory_refinement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/linear/calibrate_linear.h"
#include "calib/linear/outlier_report.h"
#include "calib/refine/trajectory_covariance.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::trajectory_refinement_test {

using Eigen::VectorXd;
using Law = CoulombTransition::Law;

// As rounding leaves it where torques are 1e6 times more exact than positions
// let them be predicted: the covariance was NaN.
TEST(InverseWithin, IsNothingWhereInformationIsLostToRounding) {
  const Eigen::Matrix2d seen = 2 * Eigen::Matrix2d::Identity();
  Eigen::Matrix2d information = Eigen::Vector2d(4, .5).asDiagonal();
  ASSERT_TRUE(InverseWithin(seen, information));
  EXPECT_TRUE(InverseWithin(seen, information)
                  ->isApprox(information.inverse().eval(), 1e-14));
  information(1, 1) = -1e-3;
  EXPECT_FALSE(InverseWithin(seen, information));
  information(1, 1) = std::nan("");
  EXPECT_FALSE(InverseWithin(seen, information));
}

// A SCARA with all joint terms, its encoders as noisy as its torques.
class NoisyScara : public testing::Test {
 protected:
  NoisyScara() : robot_(SampleRobot("SCARA RRPR")) {
    SetRandomInertials(&random_, &robot_);
    for (Link& link : robot_.links) {
      link.joint.viscous = Uniform(&random_, .5, 2);
      link.joint.coulomb = Uniform(&random_, .5, 2);
      link.joint.armature = Uniform(&random_, .1, .5);
      link.joint.offset = Uniform(&random_, -.5, .5);
    }
    log_ = RecordMotion(RandomMultisine(&random_, 4), 20, .005);
    AddTorque(robot_, &log_);
    for (int j = 0; j < 4; ++j) {
      AddCoulomb(j, robot_.links[j].joint.coulomb, {Law::kVelocity, kWidth},
                 &log_);
      log_.tau.col(j).array() += robot_.links[j].joint.offset;
    }
    torque_noise_ = .01 * ColumnRms(log_.tau);
    AddNoise(&random_, kEncoder, &log_.q);
    AddNoise(&random_, torque_noise_, &log_.tau);
  }
  LogSet Logs() const {
    LogReaderOptions reader;
    reader.joint_names = robot_.JointNames();
    return LogSet({WriteFile(LogCsv(log_))}, reader, {});
  }
  TrajectoryRefinement Refine() {
    LogSet logs = Logs();
    start_.emplace_back(CalibrateLinear(robot_, options_, logs, nullptr));
    return RefineTrajectories(robot_, options_, start_[0], logs, nullptr);
  }
  // rms of errors in units of what `result` claims.
  double Normalised(const LinearCalibration& result) const {
    const VectorXd z = (result.x - result.parameters.Values(robot_))
                           .cwiseQuotient(result.stddev);
    return z.norm() / std::sqrt(static_cast<double>(z.size()));
  }

  static constexpr double kWidth = .05;
  const VectorXd kEncoder = Eigen::Vector4d(1e-4, 2e-4, 5e-5, 3e-4);
  std::mt19937_64 random_{11};
  Robot robot_;
  Log log_;
  VectorXd torque_noise_;
  LinearCalibrationOptions options_;
  std::vector<LinearCalibration> start_;
};

TEST_F(NoisyScara, FindsNoiseWidthsAndParameters) {
  const TrajectoryRefinement result = Refine();
  const LinearCalibration& c = result.calibration;
  ASSERT_TRUE(result.refined && result.converged) << result.reason;
  for (int j = 0; j < 4; ++j) {
    EXPECT_NEAR(c.encoder_noise[j] / kEncoder[j], 1, .05) << j;
    EXPECT_NEAR(c.noise[j] / torque_noise_[j], 1, .06) << j;
    EXPECT_NEAR(std::log(c.transitions[j].width / kWidth), 0, .15) << j;
  }
  EXPECT_GT(Normalised(c), .6);
  EXPECT_LT(Normalised(c), 1.4);
  // Encoders this noisy are what weak rows do not treat best.
  const VectorXd ratio = c.stddev.cwiseQuotient(start_[0].stddev);
  EXPECT_LT(ratio.mean(), .9);
  EXPECT_EQ(c.covariance_method.rfind("independent samples", 0), 0u);
}

// Torques that follow each other: the claim must grow by about
// sqrt((1 + rho) / (1 - rho)).
TEST_F(NoisyScara, AutocorrelatedTorquesWidenTheIntervals) {
  const double white = Refine().calibration.stddev.mean();
  start_.clear();
  constexpr double kRho = .8;
  VectorXd noise = VectorXd::Zero(4);
  for (int k = 0; k < log_.size(); ++k) {
    for (int j = 0; j < 4; ++j) {
      noise[j] = kRho * noise[j] + std::sqrt(1 - kRho * kRho) * 3 *
                                       torque_noise_[j] * Normal(&random_);
      log_.tau(k, j) += noise[j];
    }
  }
  const TrajectoryRefinement result = Refine();
  ASSERT_TRUE(result.refined) << result.reason;
  EXPECT_EQ(result.calibration.covariance_method.rfind("Newey-West", 0), 0u);
  EXPECT_GT(result.calibration.inflation, 1.5);
  EXPECT_LT(result.calibration.inflation, 4);
  EXPECT_GT(result.calibration.stddev.mean(), 3 * white);
  EXPECT_LT(Normalised(result.calibration), 1.6);
}

TEST_F(NoisyScara, SparesOutliers) {
  for (int k = 100; k < log_.size(); k += 40) {  // 2.5 % of the samples
    log_.tau.row(k) += 50 * torque_noise_.transpose();
  }
  options_.bandwidth_hz = 8;
  const TrajectoryRefinement result = Refine();
  ASSERT_TRUE(result.refined) << result.reason;
  EXPECT_LT(Normalised(result.calibration), 1.5);
  for (const long outliers : result.calibration.outliers) {
    EXPECT_GT(outliers, .024 * log_.size());
  }
}

TEST_F(NoisyScara, LeavesAnUnsolvedStartAsItIs) {
  log_.tau.setZero();
  const TrajectoryRefinement result = Refine();
  EXPECT_FALSE(result.refined);
  EXPECT_EQ(result.reason, start_[0].reason);
  EXPECT_EQ(result.calibration.encoder_noise.size(), 0);
}

// What is left is the start, which was made without the gross errors and says
// so.
TEST_F(NoisyScara, AFailedRefinementKeepsTheStartsOutliers) {
  constexpr double kBeyondSplines = 1e100;
  for (int k = 150; k < log_.size(); k += 400) {
    log_.tau(k, 1) += 40 * torque_noise_[1];
  }
  log_.tau *= kBeyondSplines;
  const TrajectoryRefinement result = Refine();
  ASSERT_TRUE(start_[0].solved) << start_[0].reason;
  ASSERT_FALSE(result.refined);
  EXPECT_EQ(CountOutliers(start_[0]), 10);
  EXPECT_EQ(CountOutliers(result.calibration), 10);
  EXPECT_EQ(result.calibration.preparation.outliers,
            start_[0].preparation.outliers);
}

}  // namespace armcal::trajectory_refinement_test
