#include "calib/excite/given_information.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "calib/linear/calibrate_linear.h"
#include "calib/linear/error_density.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::given_information_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class GivenInformationTest : public testing::Test {
 protected:
  static constexpr double kStep = .01;

  GivenInformationTest() : robot_(SampleRobot("3R elbow")) {
    SetRandomInertials(&random_, &robot_);
    Log log = RecordMotion(RandomMultisine(&random_, 3), 40, kStep);
    AddTorque(robot_, &log);
    sigma_ = .02 * ColumnRms(log.tau);
    AddNoise(&random_, sigma_, &log.tau);
    LogReaderOptions reader;
    reader.joint_names = robot_.JointNames();
    logs_.emplace(LogFiles({WriteFile(LogCsv(log), "given.csv")}), reader,
                  TimeRange());
    LinearCalibrationOptions options;
    options.joint_terms = {};
    linear_.emplace(CalibrateLinear(robot_, options, *logs_, nullptr));
  }

  PreparedLogs Prepared() const {
    return Prepare(*logs_, linear_->preparation);
  }

  std::mt19937_64 random_{8};
  Robot robot_;
  VectorXd sigma_;
  std::optional<LogSet> logs_;
  std::optional<LinearCalibration> linear_;
};

// White noise of sigma per sample of dt has a power of sigma^2 dt per Hz.
TEST_F(GivenInformationTest, TheDensityIsThatOfTheNoise) {
  const VectorXd density = ErrorDensity(*linear_);
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(density[j] / (sigma_[j] * sigma_[j] * kStep), 1, .3) << j;
  }
}

// Its inverse is the covariance that the calibration finds.
TEST_F(GivenInformationTest, IsTheInverseOfACalibrationsCovariance) {
  const MatrixXd A = GivenInformation(robot_, linear_->parameters,
                                      ErrorDensity(*linear_), {}, Prepared());
  const MatrixXd covariance =
      A.llt().solve(MatrixXd::Identity(A.rows(), A.cols()));
  const VectorXd ratio =
      linear_->stddev.cwiseQuotient(covariance.diagonal().cwiseSqrt());
  EXPECT_NEAR(std::exp(ratio.array().log().mean()), 1, .2);
}

TEST_F(GivenInformationTest, SegmentsAddUp) {
  const VectorXd density = VectorXd::Ones(3);
  const MatrixXd whole =
      GivenInformation(robot_, linear_->parameters, density, {}, Prepared());
  const auto segments = InformationBySegment(robot_, linear_->parameters,
                                             density, 7, {}, Prepared());
  ASSERT_EQ(segments.size(), 6u);
  MatrixXd sum = 0 * whole;
  for (size_t k = 0; k < segments.size(); ++k) {
    EXPECT_EQ(segments[k].range.begin, 7. * static_cast<double>(k));
    sum += segments[k].A;
  }
  EXPECT_LT((sum - whole).norm(), 1e-9 * whole.norm());
}

}  // namespace armcal::given_information_test
