#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration_model.h"
#include "calib/refine/trajectory_correction.h"
#include "calib/refine/trajectory_refinement.h"
#include "tests/fixtures/monte_carlo.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::trajectory_refinement_long_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// ARMCAL_RUNS=200 is what the bars are made for; fewer have some slack.
int Runs(int committed) {
  const char* runs = std::getenv("ARMCAL_RUNS");
  return runs != nullptr ? std::atoi(runs) : committed;
}
// How much larger than with 200 runs a standard error of sigma / sqrt(runs) is.
double Slack(double runs, double sigma) {
  return sigma * std::max(0.0, 1 / std::sqrt(runs) - 1 / std::sqrt(200));
}

struct Setting {
  std::string name;
  std::string robot;
  GeometryKnowledge geometry;
  bool joint_terms;
  int runs;
};

// 10 s of an arm at 250 Hz; encoders with 1e-4 rad (m), torques with 1 %.
struct Simulation {
  explicit Simulation(const Setting& setting)
      : robot(SampleRobot(setting.robot)) {
    SetRandomInertials(&random, &robot);
    options.geometry = setting.geometry;
    if (!setting.joint_terms) options.joint_terms = {};
    const int n = robot.num_joints();
    for (Link& link : robot.links) {
      if (!setting.joint_terms) break;
      link.joint.viscous = Uniform(&random, .5, 2);
      link.joint.coulomb = Uniform(&random, .5, 2);
      link.joint.armature = Uniform(&random, .1, .5);
      link.joint.offset = Uniform(&random, -.5, .5);
    }
    exact = RecordMotion(RandomMultisine(&random, n), 10, .004);
    AddTorque(robot, &exact);
    const CoulombTransition transition{CoulombTransition::Law::kVelocity, .05};
    for (int j = 0; j < n; ++j) {
      AddCoulomb(j, robot.links[j].joint.coulomb, transition, &exact);
      exact.tau.col(j).array() += robot.links[j].joint.offset;
    }
    noise.encoder.setConstant(n, 1e-4);
    noise.torque = .01 * ColumnRms(exact.tau);
    model.emplace(MakeParameters(
        robot, options,
        setting.joint_terms ? Transitions(n, {transition}) : Transitions()));
  }
  LogSet Record() {
    Log log = exact;
    AddNoise(&random, noise.encoder, &log.q);
    AddNoise(&random, noise.torque, &log.tau);
    LogReaderOptions reader;
    reader.joint_names = robot.JointNames();
    return LogSet({WriteFile(LogCsv(log))}, reader, {});
  }
  // Cramer and Rao's bound on standard deviations, at the truth, with splines
  // and widths unknown.
  VectorXd Bound(double knot_s) const {
    const Trajectory motion = MakeTrajectory(exact);
    TrajectoryCorrection truth(*model, knot_s);
    EXPECT_TRUE(truth.Enter(motion));
    EXPECT_TRUE(
        truth.Fit(model->Values(robot), noise, TorqueWeighting::kSquared, 1));
    MatrixXd information = MatrixXd::Zero(truth.border(), truth.border());
    VectorXd gradient = VectorXd::Zero(truth.border());
    NoiseSums encoder(robot.num_joints()), torque(robot.num_joints());
    EXPECT_TRUE(truth.Eliminate(&information, &gradient, &encoder, &torque));
    const VectorXd s = information.diagonal().cwiseSqrt().cwiseInverse();
    const MatrixXd scaled = s.asDiagonal() * information * s.asDiagonal();
    return scaled.inverse().diagonal().cwiseSqrt().cwiseProduct(s).head(
        model->size());
  }

  std::mt19937_64 random{5};
  Robot robot;
  LinearCalibrationOptions options;
  Log exact;
  TrajectoryNoise noise;
  std::optional<ModelParameters> model;
};

void AddLengths(const LinearCalibration& result,
                std::optional<MonteCarlo>* lengths) {
  std::vector<double> truth, value, stddev;
  for (const RecoveredLength& l : result.lengths) {
    if (!l.identifiable) continue;
    truth.push_back(l.nominal);
    value.push_back(l.value);
    stddev.push_back(l.stddev);
  }
  if (truth.empty()) return;
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::Map<const VectorXd>(v.data(), v.size());
  };
  if (!*lengths) lengths->emplace(vector(truth));
  (*lengths)->Add(vector(value), vector(stddev));
}

void ExpectCoverage(const char* what, const MonteCarlo& result) {
  std::printf(
      "%s: 95 %% intervals hold the truth in %.1f %% (worst %.1f %%), "
      "claimed over true deviation %.3f\n",
      what, result.coverage(), result.least_coverage(),
      Median(result.honesty()));
  EXPECT_GT(result.coverage(), 93 - Slack(result.runs, 15)) << what;
  EXPECT_LT(result.coverage(), 97 + Slack(result.runs, 15)) << what;
  // Three standard errors of a share of .88, as the least of many scatters.
  EXPECT_GE(result.least_coverage(), 88 - Slack(result.runs, 97.5)) << what;
}

class NoisyEncoders : public testing::TestWithParam<Setting> {};

TEST_P(NoisyEncoders, EstimatesAreAsGoodAsCanBeAndSayHowGood) {
  Simulation simulation(GetParam());
  const VectorXd X = simulation.model->Values(simulation.robot);
  MonteCarlo weak(X), corrected(X);
  std::optional<MonteCarlo> weak_lengths, corrected_lengths;
  VectorXd bound;
  for (int run = 0; run < Runs(GetParam().runs); ++run) {
    LogSet logs = simulation.Record();
    const LinearCalibration start =
        CalibrateLinear(simulation.robot, simulation.options, logs, nullptr);
    const TrajectoryRefinement refinement = RefineTrajectories(
        simulation.robot, simulation.options, start, logs, nullptr);
    ASSERT_TRUE(refinement.refined) << refinement.reason;
    weak.Add(start);
    corrected.Add(refinement.calibration);
    AddLengths(start, &weak_lengths);
    AddLengths(refinement.calibration, &corrected_lengths);
    if (run == 0) bound = simulation.Bound(refinement.knot_s);
  }
  ExpectCoverage("weak rows", weak);
  ExpectCoverage("corrected", corrected);
  if (weak_lengths) ExpectCoverage("lengths, weak rows", *weak_lengths);
  if (corrected_lengths)
    ExpectCoverage("lengths, corrected", *corrected_lengths);
  const double weak_ratio = Median(weak.rmse().cwiseQuotient(bound));
  const double ratio = Median(corrected.rmse().cwiseQuotient(bound));
  std::printf("rmse over bound, median: weak %.3f, corrected %.3f\n",
              weak_ratio, ratio);
  EXPECT_LT(weak_ratio, 1.20 + Slack(weak.runs, .7));
  EXPECT_LT(ratio, 1.07 + Slack(weak.runs, .7));
}

INSTANTIATE_TEST_SUITE_P(
    Robots, NoisyEncoders,
    testing::Values(Setting{"Scara", "SCARA RRPR",
                            GeometryKnowledge::kNonzeroLengths, false, 60},
                    Setting{"Puma", "PUMA560 6R",
                            GeometryKnowledge::kNonzeroLengths, false, 30},
                    Setting{"Ur5WithJointTerms", "UR5 6R",
                            GeometryKnowledge::kKnown, true, 30},
                    Setting{"Panda", "Panda 7R",
                            GeometryKnowledge::kNonzeroLengths, false, 25}),
    [](const auto& info) { return info.param.name; });

// 10 s at 500 Hz with 1 % torque noise (a linear fit that knows
// positions, velocities and accelerations exactly has .31 mm on its motion).
TEST(PumaLengths, UpperArmToAThirdOfAMillimetre) {
  Robot robot = SampleRobot("PUMA560 6R");
  std::mt19937_64 inertials(11), random(12);
  SetRandomInertials(&inertials, &robot);
  Log log = RecordMotion(RandomMultisine(&random, 6, 1.2), 10, .002);
  AddTorque(robot, &log);
  AddNoise(&random, .01 * ColumnRms(log.tau), &log.tau);
  AddNoise(&random, VectorXd::Constant(6, 1e-5), &log.q);
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  LogSet logs({WriteFile(LogCsv(log))}, reader, {});
  LinearCalibrationOptions options;
  options.geometry = GeometryKnowledge::kNonzeroLengths;
  options.joint_terms = {};
  const LinearCalibration weak = CalibrateLinear(robot, options, logs, nullptr);
  const TrajectoryRefinement corrected =
      RefineTrajectories(robot, options, weak, logs, nullptr);
  for (const auto* lengths : {&weak.lengths, &corrected.calibration.lengths}) {
    for (const RecoveredLength& l : *lengths) {
      std::printf("%s: stddev %.3f mm, error %.3f mm\n", l.symbol.c_str(),
                  1e3 * l.stddev, 1e3 * (l.value - l.nominal));
      if (l.symbol != "a2") continue;
      EXPECT_LT(l.stddev, .32e-3);
      EXPECT_LT(std::abs(l.value - l.nominal), 3 * l.stddev);
    }
  }
}

}  // namespace armcal::trajectory_refinement_long_test
