#include "calib/closed_loop/output_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "calib/closed_loop/output_error_report.h"
#include "tests/fixtures/commanded_arm.h"

namespace armcal::output_error_test {

constexpr double kNoise = 1e-4;  // rad

// Armature, damping, friction and delay of Simbody's arms, from positions with
// an encoder's noise: within their deviations, which are small.
TEST(OutputErrorTest, FindsWhatPositionsTell) {
  for (const int n : {1, 3}) {
    const Robot truth = CommandedTruth(n);
    const ControllerOptions controller = CommandedController(truth);
    OutputErrorOptions options;
    options.trust.inertia = 0;
    const CommandedLog log =
        RecordCommands(truth, controller, 6, {kNoise, kNoise});
    const OutputErrorCalibration result =
        CalibrateOutputError(FileOf(truth), controller, options, {log}, {log});
    ASSERT_TRUE(result.arm.converged()) << result.arm.reason;
    const auto expected = TrueValues(truth);
    size_t found = 0;
    for (const PhysicalParameter& p : result.arm.parameters) {
      const auto value = expected.find(p.name);
      if (value == expected.end()) continue;
      ++found;
      EXPECT_TRUE(p.identifiable) << p.name;
      EXPECT_LT(p.stddev, .25 * value->second) << p.name;
      EXPECT_NEAR(p.value, value->second, 3.5 * p.stddev) << p.name;
    }
    EXPECT_EQ(found, expected.size());
    EXPECT_NEAR(result.model_error, .97, .1);
    for (int j = 0; j < n; ++j) {
      EXPECT_GT(result.positions.nominal[j], 5 * kNoise);
      EXPECT_LT(result.positions.calibrated[j], 1.2 * kNoise);
      EXPECT_LT(result.positions.validation[j], 1.2 * kNoise);
    }
    // An integral part takes any constant torque.
    EXPECT_EQ(result.arm.unseen.size(), static_cast<size_t>(n));
  }
}

// What is drawn of a log that was held out: how far the arm was from its
// command, and that the estimate follows it to the noise where the file does
// not.
TEST(OutputErrorTest, TracesWhatIsHeldOut) {
  const Robot truth = CommandedTruth(1);
  const ControllerOptions controller = CommandedController(truth);
  const auto record = [&](int seed) {
    return RecordCommands(truth, controller, 6, {kNoise, kNoise}, seed);
  };
  OutputErrorOptions options;
  options.trace_bins = 10000;
  const CommandedLog held_out = record(2);
  const OutputErrorCalibration result = CalibrateOutputError(
      FileOf(truth), controller, options, {record(1)}, {held_out});
  ASSERT_EQ(result.traces.size(), 1u);
  EXPECT_EQ(result.traces[0].log, held_out.path);
  const auto& bins = result.traces[0].follows.bins();
  ASSERT_GT(bins.size(), 500u);
  EXPECT_GE(bins[0].begin, 1);  // the first second is the simulation's own
  double by_file = 0, by_estimate = 0;
  for (const SeriesEnvelope::Bin& bin : bins) {
    ASSERT_EQ(bin.low.size(), 5);
    long row = 0;
    while (held_out.log.t[row] < bin.begin) ++row;
    EXPECT_EQ(bin.low[0], held_out.log.q(row, 0) - held_out.log.qref(row, 0));
    // Simulated minus commanded and measured minus simulated.
    EXPECT_NEAR(bin.low[1] + bin.low[3], bin.low[0], 1e-12);
    EXPECT_NEAR(bin.low[2] + bin.low[4], bin.low[0], 1e-12);
    by_file += bin.low[3] * bin.low[3];
    by_estimate += bin.low[4] * bin.low[4];
  }
  const auto size = static_cast<double>(bins.size());
  EXPECT_NEAR(std::sqrt(by_estimate / size), result.positions.validation[0],
              1e-9);
  EXPECT_LT(std::sqrt(by_estimate / size), 1.5 * kNoise);
  EXPECT_GT(std::sqrt(by_file / size), 10 * kNoise);
}

// Without gravity no position tells how large torques are: with gains that are
// not known, all of them could be twice as large.
TEST(OutputErrorTest, ScaleOfTorqueNeedsGainsOrGravity) {
  Robot truth = CommandedTruth(1);
  truth.gravity.setZero();
  const ControllerOptions controller = CommandedController(truth);
  const CommandedLog log =
      RecordCommands(truth, controller, 6, {kNoise, kNoise});
  const auto identifiable = [&](double gains, const std::string& name) {
    OutputErrorOptions options;
    options.trust.gains = gains;
    const OutputErrorCalibration result =
        CalibrateOutputError(FileOf(truth), controller, options, {log}, {});
    EXPECT_TRUE(result.arm.converged()) << result.arm.reason;
    for (const PhysicalParameter& p : result.arm.parameters) {
      if (p.name == name) return p.identifiable;
    }
    ADD_FAILURE() << name;
    return false;
  };
  EXPECT_TRUE(identifiable(0, "joint1.coulomb"));
  EXPECT_FALSE(identifiable(1, "joint1.coulomb"));
  EXPECT_FALSE(identifiable(1, "joint1.kp"));
}

// ... or another log with torques, which also finds what they find alone.
TEST(OutputErrorTest, TorquesOfAnotherLogTellTheScale) {
  Robot truth = CommandedTruth(1);
  truth.gravity.setZero();
  const ControllerOptions controller = CommandedController(truth);
  ControllerOptions file = controller;
  file.drives[0].kp *= 1.4;
  file.drives[0].kd *= .7;
  const TorqueInformation torques =
      TorquesOf(RecordCommands(truth, controller, 6, {kNoise, kNoise}, 2),
                FileOf(truth), .05, 3);
  ASSERT_EQ(torques.reason, "");
  OutputErrorOptions options;
  options.trust.inertia = 0;
  options.trust.gains = 1;
  const OutputErrorCalibration result = CalibrateOutputError(
      FileOf(truth), file, options,
      {RecordCommands(truth, controller, 6, {kNoise, kNoise})}, {}, &torques);
  ASSERT_TRUE(result.arm.converged()) << result.arm.reason;
  auto expected = TrueValues(truth);
  expected["joint1.kp"] = controller.drives[0].kp;
  expected["joint1.kd"] = controller.drives[0].kd;
  for (const PhysicalParameter& p : result.arm.parameters) {
    const auto value = expected.find(p.name);
    if (value == expected.end()) continue;
    EXPECT_TRUE(p.identifiable) << p.name;
    EXPECT_LT(std::abs(p.value - value->second), 3.5 * p.stddev) << p.name;
    EXPECT_LT(p.stddev, .06 * value->second) << p.name;
  }
}

// Logs whose torques tell nothing are named.
TEST(OutputErrorTest, RefusesWithTheTorquesReason) {
  const Robot truth = CommandedTruth(1);
  const ControllerOptions controller = CommandedController(truth);
  TorqueInformation torques;
  torques.reason = "nothing moves";
  const OutputErrorCalibration result = CalibrateOutputError(
      FileOf(truth), controller, {},
      {RecordCommands(truth, controller, 6, {kNoise, kNoise})}, {}, &torques);
  EXPECT_FALSE(result.arm.solved);
  EXPECT_EQ(result.arm.reason, "the logs with torques: nothing moves");
}

// A file whose arm is far too light for the gains: its simulated loop swings
// from limit to limit, and no deviation by it means anything.
TEST(OutputErrorTest, AnUnstableLoopIsNamed) {
  const Robot truth = CommandedTruth(1);
  ControllerOptions controller = CommandedController(truth);
  const CommandedLog log =
      RecordCommands(truth, controller, 6, {kNoise, kNoise});
  Robot light = truth;
  light.links[0].inertial.mass *= .01;
  light.links[0].inertial.first_moment *= .01;
  light.links[0].inertial.inertia *= .01;
  light.links[0].joint.viscous = light.links[0].joint.coulomb = 0;
  light.links[0].joint.armature = 0;
  for (DriveLaw& drive : controller.drives) drive.torque_limit = 20;
  const OutputErrorCalibration result =
      CalibrateOutputError(light, controller, {}, {log}, {});
  EXPECT_FALSE(result.arm.solved);
  EXPECT_EQ(result.arm.reason.find("the simulated loop is unstable"), 0u)
      << result.arm.reason;
  EXPECT_TRUE(result.arm.parameters.empty());
  const std::string report = OutputErrorReport(light, result);
  EXPECT_EQ(report.find("+-"), std::string::npos) << report;
  EXPECT_NE(report.find("give its joints their friction"), std::string::npos);
}

// Less than the noise itself is left where jitter was taken for noise; more,
// where the loops amplify it.
TEST(OutputErrorTest, TellsJitterFromInstability) {
  const Robot robot = CommandedTruth(1);
  OutputErrorCalibration result;
  result.arm.solved = true;
  result.model_error = .4;
  result.positions.nominal = Eigen::VectorXd::Constant(1, 1e-2);
  result.positions.noise = Eigen::VectorXd::Constant(1, 2e-3);
  result.positions.calibrated = Eigen::VectorXd::Constant(1, 7e-4);
  const std::string jitter = OutputErrorReport(robot, result);
  EXPECT_NE(jitter.find("stamps that jitter"), std::string::npos);
  EXPECT_EQ(jitter.find("near instability"), std::string::npos);
  result.positions.calibrated *= 3;
  const std::string shaken = OutputErrorReport(robot, result);
  EXPECT_EQ(shaken.find("stamps that jitter"), std::string::npos);
  EXPECT_NE(shaken.find("near instability"), std::string::npos);
}

// A guess of the gains that counts as exact is made up for by friction and
// delay, which other commands show: by the sum over joints in units of their
// noise, the second one's being small beside the first one's.
TEST(OutputErrorTest, IsNoBetterModelIfTheFileFollowsHeldOutCommands) {
  OutputErrorCalibration result;
  result.arm.robot = CommandedTruth(2);
  result.arm.solved = true;
  result.arm.reason = "CONVERGENCE";
  result.arm.parameters.resize(1);
  result.arm.parameters[0].identifiable = true;
  result.positions.noise = Eigen::Vector2d(1e-4, 1e-3);
  result.positions.calibrated = Eigen::Vector2d(.01, .01);
  result.positions.nominal_validation = Eigen::Vector2d(.02, .02);
  result.positions.validation = Eigen::Vector2d(.01, .04);
  EXPECT_TRUE(Shortcomings(result).empty());
  // By chance, as of a file that is the truth.
  result.positions.validation = Eigen::Vector2d(.0201, .02);
  EXPECT_TRUE(Shortcomings(result).empty());
  result.positions.validation = Eigen::Vector2d(.03, .01);
  ASSERT_EQ(Shortcomings(result).size(), 1u);
  EXPECT_NE(Shortcomings(result)[0].find("joint1: 0.03 instead of 0.02 rad"),
            std::string::npos)
      << Shortcomings(result)[0];
  // A joint that stood still sags by .1 mrad.
  result.positions.noise[1] = 1e-9;
  result.positions.validation = Eigen::Vector2d(.01, .0201);
  EXPECT_TRUE(Shortcomings(result).empty());
  result.positions.validation[0] = std::numeric_limits<double>::infinity();
  ASSERT_EQ(Shortcomings(result).size(), 1u);
  EXPECT_NE(Shortcomings(result)[0].find("unstable"), std::string::npos);
  result.positions.validation.resize(0);
  EXPECT_TRUE(Shortcomings(result).empty());
}

// Commands that are stamped 10 ms late seem to be followed before they are
// given.
TEST(OutputErrorTest, NoCommandIsFollowedBeforeItIsGiven) {
  const Robot truth = CommandedTruth(1);
  ControllerOptions controller = CommandedController(truth);
  CommandedLog log = RecordCommands(truth, controller, 6, {kNoise, kNoise});
  const double step = log.log.t[1] - log.log.t[0];
  const auto late = static_cast<Eigen::Index>(std::lround(.01 / step));
  const Eigen::Index rows = log.log.qref.rows();
  const Eigen::MatrixXd given = log.log.qref.topRows(rows - late);
  log.log.qref.bottomRows(rows - late) = given;
  const OutputErrorCalibration result =
      CalibrateOutputError(FileOf(truth), controller, {}, {log}, {});
  const auto& all = result.arm.parameters;
  const auto delay = std::find_if(
      all.begin(), all.end(),
      [](const PhysicalParameter& p) { return p.name == "drive.delay"; });
  ASSERT_NE(delay, all.end());
  EXPECT_TRUE(delay->at_bound);
  EXPECT_EQ(delay->value, 0);
}

}  // namespace armcal::output_error_test
