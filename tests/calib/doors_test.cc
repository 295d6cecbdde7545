#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "calib/calibrate.h"
#include "calib/diagnose.h"
#include "calib/excite.h"
#include "calib/inspect.h"
#include "calib/verify.h"
#include "model/robot_files/mjcf/mjcf_reader.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/option_error.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::doors_test {

using testing::HasSubstr;

// A pendulum of 2 kg on a massless rod of .5 m whose hinge turns about the
// world's -y, so that q > 0 is up from the horizontal:
// tau = m g l cos(q) + (m l^2 + armature) qdd + viscous qd.
struct Pendulum {
  Pendulum() {
    robot.name = "pendulum";
    robot.links.resize(1);
    Link& rod = robot.links[0];
    rod.name = "rod";
    rod.joint.name = "hinge";
    rod.joint.viscous = .3;
    rod.X_PF = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX());
    rod.has_inertial = true;
    rod.inertial = InertialParameters::FromCenterOfMass(
        2, {.5, 0, 0}, 1e-3 * Eigen::Matrix3d::Identity());
    log.t = Eigen::ArrayXd::LinSpaced(4001, 0, 4000).round() / 200;
    const Eigen::ArrayXd w = 2 * log.t.array(), v = 5.3 * log.t.array();
    log.q = w.sin() + .3 * v.sin();
    const Eigen::ArrayXd qd = 2 * w.cos() + .3 * 5.3 * v.cos();
    const Eigen::ArrayXd qdd = -4 * w.sin() - .3 * 5.3 * 5.3 * v.sin();
    log.tau = 9.81 * log.q.array().cos() + .501 * qdd + .3 * qd;
    std::mt19937_64 random(1);
    AddNoise(&random, Eigen::VectorXd::Constant(1, 1e-5), &log.q);
    AddNoise(&random, Eigen::VectorXd::Constant(1, .02), &log.tau);
  }
  LogInput InMemory() const { return {{{"swings", log}}}; }

  Robot robot;
  Log log;
};

CalibrateOptions OneTerm() {
  CalibrateOptions options;
  options.equations.joint_terms = {JointTerm::kViscous};
  return options;
}

double ValueOf(const CalibrateSummary& summary, const std::string& name) {
  for (const EstimatedParameter& p : summary.parameters) {
    if (p.name == name) return p.value;
  }
  ADD_FAILURE() << "no parameter " << name;
  return 0;
}

// The link between two joints of an MJCF body needs no mass to start from.
TEST(Doors, CalibrateMakesARobotOfABodyWithTwoJoints) {
  const Robot robot = ReadMjcf(
      {"ball.xml",
       "<mujoco><worldbody><body name='b'><joint name='j1' axis='0 1 0'/>"
       "<joint name='j2'/><inertial pos='.1 0 .2' mass='2' "
       "diaginertia='.02 .03 .025'/></body></worldbody></mujoco>"},
      {});
  std::mt19937_64 random(3);
  Log log = RecordMotion(RandomMultisine(&random, 2, 1.2), 20, .01);
  AddTorque(robot, &log);
  AddNoise(&random, .01 * ColumnRms(log.tau), &log.tau);
  const CalibrateSummary summary =
      Calibrate(robot, {{{"swings", log}}}, OneTerm());
  EXPECT_TRUE(summary.robot) << summary.report;
  EXPECT_EQ(ValueOf(summary, "b_j1.mass"), 0);
}

// A motor of 12 N m/A behind a gear of its own inertia and friction.
TEST(Doors, CalibrateTellsWhatLiesBeforeATorqueSensor) {
  Pendulum pendulum;
  Log& log = pendulum.log;
  const Eigen::ArrayXd t = log.t.array();
  const Eigen::ArrayXd qd = 2 * (2 * t).cos() + .3 * 5.3 * (5.3 * t).cos();
  const Eigen::ArrayXd qdd =
      -4 * (2 * t).sin() - .3 * 5.3 * 5.3 * (5.3 * t).sin();
  log.current =
      (log.tau.array() + .1 * qdd + .5 * qd + .8 * (qd / .01).tanh()) / 12;
  const CalibrateSummary summary =
      Calibrate(pendulum.robot, pendulum.InMemory(), OneTerm());
  const auto json = nlohmann::json::parse(summary.json);
  const auto& drive = json["drive_trains"]["joints"][0];
  EXPECT_EQ(drive["joint"], "hinge");
  EXPECT_EQ(drive["unit"], "N m/A");
  EXPECT_NEAR(drive["torque_constant"], 12, .05);
  EXPECT_NEAR(drive["armature"], .1, .01);
  EXPECT_NEAR(drive["viscous"], .5, .03);
  EXPECT_NEAR(drive["coulomb"], .8, .05);
  EXPECT_THAT(summary.report, HasSubstr("joint torques"));
  EXPECT_NEAR(ValueOf(summary, "hinge.viscous"), .3, .01);
}

TEST(Doors, CalibrateFindsAPendulumInMemory) {
  const Pendulum pendulum;
  CalibrateOptions options = OneTerm();
  options.target = CalibrationTarget::kLinear;
  const CalibrateSummary summary =
      Calibrate(pendulum.robot, pendulum.InMemory(), options);
  ASSERT_TRUE(summary.solved && summary.positive) << summary;
  EXPECT_NEAR(ValueOf(summary, "hx[1]"), 1, 1e-3);
  EXPECT_NEAR(ValueOf(summary, "Izz[1]"), .501, 1e-3);
  EXPECT_NEAR(ValueOf(summary, "viscous[1]"), .3, 2e-3);
  EXPECT_FALSE(summary.robot);
  EXPECT_THAT(summary.json, HasSubstr("\"file\": \"swings\""));
}

// All digits, which logs for people do not have.
std::string ExactCsv(const Log& log) {
  std::string text = "t,q1,tau1\n";
  for (int k = 0; k < log.size(); ++k) {
    text += Format("%.3f,%.17g,%.17g\n", log.t[k], log.q(k, 0), log.tau(k, 0));
  }
  return text;
}

// A file of the same numbers gives the same bytes, under the same name.
TEST(Doors, ALogInMemoryIsItsFile) {
  const Pendulum pendulum;
  const std::string path = WriteFile(ExactCsv(pendulum.log), "swings.csv");
  const CalibrateSummary of_file =
      Calibrate(pendulum.robot, {{path}}, OneTerm());
  const CalibrateSummary of_memory =
      Calibrate(pendulum.robot, {{{path, pendulum.log}}}, OneTerm());
  EXPECT_EQ(of_memory.json, of_file.json);
  EXPECT_EQ(of_memory.report, of_file.report);
  ASSERT_TRUE(of_memory.robot);
}

TEST(Doors, OptionsAreValidAsConstructed) {
  const Pendulum pendulum;
  const DiagnoseSummary diagnosis =
      Diagnose(pendulum.robot, pendulum.InMemory(), DiagnoseOptions());
  EXPECT_EQ(diagnosis.verdict, "noise_floor") << diagnosis;
  EXPECT_TRUE(diagnosis.effects.empty());
  const VerifySummary verification =
      Verify(pendulum.robot, pendulum.InMemory(), VerifyOptions());
  EXPECT_TRUE(verification.positive) << verification;
  EXPECT_TRUE(verification.shortcomings.empty());
  EXPECT_TRUE(Verify(pendulum.robot, {}, VerifyOptions()).positive);
  const InspectSummary inspected =
      Inspect(pendulum.robot, pendulum.InMemory().logs, InspectOptions());
  ASSERT_EQ(inspected.logs.size(), 1u);
  EXPECT_TRUE(inspected.logs[0].as_it_is) << inspected;
  const ExciteSummary motion = Excite(pendulum.robot, ExciteOptions());
  EXPECT_TRUE(motion.positive) << motion;
  EXPECT_EQ(motion.motion.size(), 20 * 250 + 1);
}

TEST(Doors, AWrongRobotIsNotVerifiedByItsLog) {
  Pendulum pendulum;
  pendulum.log.tau *= -1;
  const InspectSummary inspected =
      Inspect(pendulum.robot, pendulum.InMemory().logs, InspectOptions());
  EXPECT_FALSE(inspected.positive);
  EXPECT_FALSE(inspected.logs[0].as_it_is);
}

TEST(Doors, RefuseWhatDoesNotGoTogether) {
  const Pendulum pendulum;
  const Robot& robot = pendulum.robot;
  const LogInput logs = pendulum.InMemory();
  EXPECT_THROW(Calibrate(robot, {}, OneTerm()), OptionError);
  EXPECT_THROW(Calibrate(robot, {{logs.logs[0], logs.logs[0]}}, OneTerm()),
               OptionError);
  CalibrateOptions options = OneTerm();
  options.exports = {"step"};
  EXPECT_THROW(Calibrate(robot, logs, options), OptionError);
  options = OneTerm();
  options.target = CalibrationTarget::kLinear;
  options.geometry = RefineGeometry::kAll;
  EXPECT_THROW(Calibrate(robot, logs, options), OptionError);
  ExciteOptions motion;
  motion.duration_s = .1;
  EXPECT_THROW(Excite(robot, motion), OptionError);
  motion = ExciteOptions();
  motion.limits.velocity = Eigen::Vector3d::Ones();
  EXPECT_THROW(Excite(robot, motion), OptionError);
  EXPECT_THROW(Calibrate(robot, {{"no such file"}}, OneTerm()), InputError);
}

TEST(Doors, SeveralRunAtOnce) {
  const Pendulum pendulum;
  const auto calibrate = [&] {
    return Calibrate(pendulum.robot, pendulum.InMemory(), OneTerm()).json;
  };
  const auto diagnose = [&] {
    return Diagnose(pendulum.robot, pendulum.InMemory(), DiagnoseOptions())
        .json;
  };
  const std::string calibrated = calibrate(), diagnosed = diagnose();
  std::string at_once[3];
  std::thread first([&] { at_once[0] = calibrate(); });
  std::thread second([&] { at_once[1] = diagnose(); });
  at_once[2] = calibrate();
  first.join();
  second.join();
  EXPECT_EQ(at_once[0], calibrated);
  EXPECT_EQ(at_once[1], diagnosed);
  EXPECT_EQ(at_once[2], calibrated);
}

}  // namespace armcal::doors_test
