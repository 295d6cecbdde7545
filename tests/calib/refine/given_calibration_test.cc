#include "calib/refine/given_calibration.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "calib/excite/given_information.h"
#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration_report.h"
#include "calib/linear/error_density.h"
#include "model/text/input_error.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::given_calibration_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;
using testing::HasSubstr;

class GivenCalibrationTest : public testing::Test {
 protected:
  GivenCalibrationTest() : robot_(SampleRobot("3R elbow")) {
    SetRandomInertials(&random_, &robot_);
  }
  // Of a motion of these joints.
  LinearCalibration Calibrate(const std::vector<int>& moving) {
    Log log = RecordMotion(RandomMultisine(&random_, 3), 20, .01);
    for (int j = 0; j < 3; ++j) {
      if (std::count(moving.begin(), moving.end(), j) > 0) continue;
      log.q.col(j).setConstant(.3);
      log.qd.col(j).setZero();
      log.qdd.col(j).setZero();
    }
    AddTorque(robot_, &log);
    AddNoise(&random_, .02 * ColumnRms(log.tau), &log.tau);
    LogReaderOptions reader;
    reader.joint_names = robot_.JointNames();
    LogSet logs({WriteFile(LogCsv(log), "log.csv")}, reader, TimeRange());
    LinearCalibrationOptions options;
    options.joint_terms = {};
    LinearCalibration result = CalibrateLinear(robot_, options, logs, nullptr);
    json_ = ToJson(robot_, logs, nullptr, result);
    csv_ = CovarianceCsv(result);
    return result;
  }
  // From the two files, as `armcal calibrate` would have written them.
  GivenCalibration Read(const ModelParameters& model) const {
    json written = json_;
    const std::filesystem::path csv = WriteFile(csv_, "covariance.csv");
    written["covariance"]["file"] = csv.filename().string();
    return ReadGivenCalibration(WriteFile(written.dump(), "calibration.json"),
                                robot_, model);
  }
  void ExpectRefused(const ModelParameters& model, const std::string& why) {
    EXPECT_THAT(MessageOf<InputError>("", [&] { Read(model); }),
                HasSubstr(why));
  }

  std::mt19937_64 random_{8};
  Robot robot_;
  json json_;
  std::string csv_;
};

TEST_F(GivenCalibrationTest, IsTheInverseOfWhatWasWritten) {
  const LinearCalibration result = Calibrate({0, 1, 2});
  const GivenCalibration given = Read(result.parameters);
  const VectorXd density = ErrorDensity(result);
  EXPECT_LT((given.density - density).norm(), 1e-12 * density.norm());
  const VectorXd unit = result.stddev;
  const MatrixXd product = given.A * result.covariance;
  const MatrixXd scaled =
      unit.cwiseInverse().asDiagonal() *
      (product.transpose() - MatrixXd::Identity(unit.size(), unit.size())) *
      unit.asDiagonal();
  EXPECT_LT(scaled.norm(), 1e-6);
}

TEST_F(GivenCalibrationTest, KnowsNothingOfWhatTheCalibrationLeftOpen) {
  const LinearCalibration result = Calibrate({1});
  const GivenCalibration given = Read(result.parameters);
  int open = 0;
  for (int k = 0; k < given.A.rows(); ++k) {
    EXPECT_EQ(given.A(k, k) > 0, result.identifiable[k]) << k;
    open += !result.identifiable[k];
  }
  EXPECT_GT(open, 0);
}

TEST_F(GivenCalibrationTest, ParametersOfAnotherModelAreRefused) {
  Calibrate({0, 1, 2});
  const Robot other = SampleRobot("2R planar (vertical plane)");
  ExpectRefused(ModelParameters(other, {}),
                "expected a parameter of the model that the motion is for");
}

TEST_F(GivenCalibrationTest, DamagedFilesAreRefused) {
  const ModelParameters model = Calibrate({0, 1, 2}).parameters;
  const json whole = json_;
  json_["robot"] = "another";
  ExpectRefused(model, "this is a calibration of another robot");
  json_ = whole;
  json_["joints"][1].erase("noise_density");
  ExpectRefused(model, "joints[1].noise_density: is missing");
  json_ = whole;
  const std::string csv = csv_;
  csv_ = csv.substr(0, csv.rfind('\n', csv.size() - 2) + 1);
  ExpectRefused(model, "rows below the names");
  csv_ = csv;
  csv_.replace(csv_.find('\n') + 1, 1, "x");
  ExpectRefused(model, "row 2, column 1: found 'x");
}

}  // namespace armcal::given_calibration_test
