#include "calib/refine/parameter_posterior.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "calib/refine/nonlinear_report.h"
#include "model/text/input_error.h"
#include "tests/fixtures/nonlinear_runs.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::parameter_posterior_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;
using testing::HasSubstr;

// A calibration in two files, as `armcal calibrate` writes them, of an arm of
// two joints whose second has no estimated armature.
class ParameterPosteriorTest : public testing::Test {
 protected:
  ParameterPosteriorTest() : robot_(SampleRobot("2R planar (vertical plane)")) {
    json joints = json::array(), names = json::array();
    for (const Link& link : robot_.links) {
      joints.push_back({{"name", link.joint.name}});
    }
    names = {"wire.x", robot_.links[1].name + ".hx",
             robot_.links[1].joint.name + ".armature",
             robot_.links[0].joint.name + ".coulomb"};
    json_ = {{"format", "armcal calibration 1"},
             {"robot", robot_.name},
             {"joints", joints},
             {"parameters_covariance", {{"names", names}}}};
    csv_ = "\"a\",\"b\",\"c\",\"d\"\n1,0,0,0\n0,4,0,-1\n0,0,0,0\n0,-1,0,9\n";
  }
  ParameterPosterior Read() const {
    json written = json_;
    const std::filesystem::path csv = WriteFile(csv_, "posterior.csv");
    if (has_file_) {
      written["parameters_covariance"]["posterior_file"] =
          csv.filename().string();
    }
    return ReadParameterPosterior(WriteFile(written.dump(), "calibration.json"),
                                  robot_);
  }
  void ExpectRefused(const std::string& why) const {
    EXPECT_THAT(MessageOf<InputError>("", [&] { Read(); }), HasSubstr(why));
  }

  Robot robot_;
  json json_;
  std::string csv_;
  bool has_file_ = true;
};

TEST_F(ParameterPosteriorTest, HasWhatWasEstimatedOfTheRobot) {
  const ParameterPosterior posterior = Read();
  ASSERT_EQ(posterior.parameters.size(), 2u);
  EXPECT_EQ(posterior.parameters[0].link, 1);
  EXPECT_FALSE(posterior.parameters[0].term);
  EXPECT_EQ(posterior.parameters[0].inertial, 1);
  EXPECT_EQ(posterior.parameters[1].link, 0);
  EXPECT_EQ(posterior.parameters[1].term, JointTerm::kCoulomb);
  EXPECT_EQ(posterior.covariance,
            (Eigen::Matrix2d() << 4, -1, -1, 9).finished());
  EXPECT_EQ(posterior.Stddev(0, JointTerm::kCoulomb), 3);
  EXPECT_EQ(posterior.Stddev(1, JointTerm::kArmature), 0);
}

TEST_F(ParameterPosteriorTest, OtherCalibrationsAreRefused) {
  has_file_ = false;
  ExpectRefused("calibrate again with this version");
  has_file_ = true;
  json_["robot"] = "another";
  ExpectRefused("this is a calibration of another robot");
  json_["robot"] = robot_.name;
  json_["joints"].push_back({{"name", "third"}});
  ExpectRefused("expected 2 joints");
}

TEST_F(ParameterPosteriorTest, DamagedMatricesAreRefused) {
  const std::string whole = csv_;
  csv_ = whole.substr(0, whole.size() - 9);
  ExpectRefused("row 5: expected 4 rows below the names");
  csv_ = whole;
  csv_.replace(csv_.find("9\n"), 1, "x");
  ExpectRefused("row 5, column 4: found 'x'");
  csv_ = whole;
  csv_.replace(csv_.find("-1\n"), 2, "-2");
  ExpectRefused("expected a symmetric matrix");
  csv_ = whole;  // two fields are empty
  csv_.replace(csv_.find("-1\n"), 2, "");
  csv_.replace(csv_.find("-1,"), 2, "");
  ExpectRefused("expected the covariance of the estimated parameters in it");
}

TEST(CalibrationFile, OfAFolderIsTheOneInIt) {
  const std::filesystem::path folder = WriteFile("{}", "file") + "_folder";
  std::filesystem::create_directory(folder);
  EXPECT_EQ(CalibrationFile(folder), folder);
  std::ofstream(folder / "calibration.json") << "{}";
  EXPECT_EQ(CalibrationFile(folder), folder / "calibration.json");
  std::filesystem::remove_all(folder);
  EXPECT_EQ(CalibrationFile("some.json"), "some.json");
}

// All joints' torque along a log, one after the other.
VectorXd TorqueOf(const Robot& robot, Log log) {
  AddTorque(robot, &log);
  for (int j = 0; j < robot.num_joints(); ++j) {
    AddCoulomb(j, robot.links[j].joint.coulomb, kTransition, &log);
    log.tau.col(j).array() += robot.links[j].joint.offset;
  }
  return log.tau.reshaped();
}

// The torque of a robot, which is linear in its parameters, by each of them.
MatrixXd TorqueByParameters(const Robot& robot, const Log& log,
                            const ParameterPosterior& posterior) {
  const VectorXd torque = TorqueOf(robot, log);
  MatrixXd columns(torque.size(), posterior.parameters.size());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const ParameterPosterior::Parameter& parameter = posterior.parameters[k];
    Robot changed = robot;
    Link& link = changed.links[parameter.link];
    if (parameter.term) {
      *TermOf(*parameter.term, &link.joint) += 1;
    } else {
      const Vector10d one = Vector10d::Unit(parameter.inertial);
      link.inertial += InertialParameters::FromVector(one);
    }
    columns.col(k) = TorqueOf(changed, log) - torque;
  }
  return columns;
}

// Mean over a motion that no calibration saw of the squared error of a
// calibrated arm's torque over the variance that it says this has; and over
// what the parameters would say that each is known for itself.
Eigen::Vector2d NormalisedError(int seed) {
  std::mt19937_64 random(seed);
  const SimulatedArm arm = MakeArm("3R elbow", .3, &random);
  const NonlinearRun run = Calibrate(arm, .01, {}, &random);
  json written = {{"format", "armcal calibration 1"}, {"robot", arm.file.name}};
  for (const Link& link : arm.file.links) {
    written["joints"].push_back({{"name", link.joint.name}});
  }
  AddParameters(run.physical, &written);
  const std::filesystem::path csv =
      WriteFile(ParametersPosteriorCsv(run.physical), "posterior.csv");
  written["parameters_covariance"]["posterior_file"] = csv.filename().string();
  const ParameterPosterior posterior = ReadParameterPosterior(
      WriteFile(written.dump(), "calibration.json"), arm.file);
  EXPECT_EQ(posterior.parameters.size(), 3u * 14);
  const Log log = MoveArm(arm.truth, 10, &random);
  const Robot& robot = run.physical.robot;
  const VectorXd error = TorqueOf(arm.truth, log) - TorqueOf(robot, log);
  const MatrixXd columns = TorqueByParameters(robot, log, posterior);
  const VectorXd together =
      (columns * posterior.covariance).cwiseProduct(columns).rowwise().sum();
  const VectorXd alone = columns.cwiseAbs2() * posterior.covariance.diagonal();
  return {error.cwiseAbs2().cwiseQuotient(together).mean(),
          error.cwiseAbs2().cwiseQuotient(alone).mean()};
}

// Truths are drawn from the prior (trust .3, where .5 is assumed): the ratio is
// 1 where the covariance is right, and chi squared of a few dozen parameters
// over twelve arms scatters by less than .2.
TEST(ParameterPosterior, CoversTheTorqueOfTheTrueRobot) {
  constexpr int kArms = 12;
  Eigen::Vector2d mean(0, 0);
  for (int seed = 1; seed <= kArms; ++seed) {
    mean += NormalisedError(seed) / kArms;
  }
  EXPECT_GT(mean[0], .4);
  EXPECT_LT(mean[0], 1.6);
  EXPECT_LT(mean[1], .05);
  RecordProperty("normalised", std::to_string(mean[0]));
  RecordProperty("alone", std::to_string(mean[1]));
}

}  // namespace armcal::parameter_posterior_test
