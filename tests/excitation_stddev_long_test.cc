#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/plant/hidden/scenario.h"
#include "tests/calibrate_logs.h"
#include "tests/rated_design.h"
#include "tests/sample_motion.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class SimulatedArms : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Arms, SimulatedArms,
                         testing::Values("scara", "puma", "ur5", "panda"));

// The motion as a controller's reference.
ReferenceMotion Follow(const Excitation& designed, int periods) {
  const FourierCoefficients f = designed.basis.Fourier(designed.numbers);
  const double period = designed.basis.period();
  const auto at = [f, period](double t) {
    ReferencePoint point{f.constant, 0 * f.constant, 0 * f.constant};
    for (Eigen::Index k = 0; k < f.sine.rows(); ++k) {
      const double w = 2 * M_PI * static_cast<double>(k + 1) / period;
      const VectorXd s = f.sine.row(k), c = f.cosine.row(k);
      const VectorXd x = s * std::sin(w * t) + c * std::cos(w * t);
      point.q += x;
      point.qd += w * (s * std::cos(w * t) - c * std::sin(w * t));
      point.qdd -= w * w * x;
    }
    return point;
  };
  return WithStandstill({periods * period, at}, .5, .5);
}

// Simbody follows the motion; what calibrations of its logs scatter by is what
// was predicted. What they claim is never less, but can be much more where so
// few rows tell so much (row_covariance.h).
TEST_P(SimulatedArms, CalibrationsScatterAsPredicted) {
  RatedDesign design(GetParam());
  const Excitation designed =
      DesignExcitation(design.robot, design.model, design.all, design.options);
  Scenario scenario;
  scenario.model = design.robot;
  scenario.motion = Follow(designed, 1);
  scenario.loop.controller =
      DefaultController(design.robot, scenario.motion.at(0).q, 10);
  scenario.loop.sensors.log_rate_hz = design.options.rate_hz;
  const ScenarioRun run = RunScenario(scenario);
  LinearCalibrationOptions options;
  options.joint_terms = kTerms;
  constexpr int kRuns = 24;
  const int m = design.model.size();
  MatrixXd x(m, kRuns), claimed(m, kRuns);
  std::mt19937_64 random(7);
  for (int k = 0; k < kRuns; ++k) {
    Log log = run.run.log;
    AddNoise(&random, design.options.torque_noise, &log.tau);
    const LinearCalibration result =
        CalibrateLogs(design.robot, {log}, options);
    ASSERT_TRUE(result.solved) << result.reason;
    ASSERT_EQ(result.x.size(), m);
    x.col(k) = result.x;
    claimed.col(k) = result.stddev;
  }
  const MatrixXd errors = x.colwise() - x.rowwise().mean();
  const VectorXd scatter =
      (errors.rowwise().squaredNorm() / (kRuns - 1)).cwiseSqrt();
  const auto ratios = [&](const VectorXd& stddev) {
    VectorXd ratio = stddev.cwiseQuotient(designed.stddev);
    std::sort(ratio.begin(), ratio.end());
    return ratio;
  };
  const VectorXd said = ratios(claimed.rowwise().mean()), is = ratios(scatter);
  std::printf(
      "%s: of %d standard deviations, claimed over predicted: median %.2f "
      "(%.2f .. %.2f); scatter of %d runs over predicted: median %.2f "
      "(%.2f .. %.2f)\n",
      GetParam(), m, said[m / 2], said[m / 20], said[m - 1 - m / 20], kRuns,
      is[m / 2], is[m / 20], is[m - 1 - m / 20]);
  EXPECT_GT(said[m / 2], .8);
  EXPECT_NEAR(is[m / 2], 1, .2);
}

// A log in which the last three joints hardly move, then what it lacks: half of
// its largest standard deviation takes a motion that knows of it at most half
// of the time that one takes that does not.
TEST(Sequential, TakesLessThanHalfOfAFreshDesign) {
  RatedDesign design("ur5");
  design.options.criterion = ExcitationCriterion::kWorst;
  design.options.starts = 20;
  Excitation poor =
      DesignExcitation(design.robot, design.model, design.all, design.options);
  poor.numbers.bottomRightCorner(poor.numbers.rows() - 1, 3) *= .05;
  MotionInformation information(design.robot, design.model);
  information.Evaluate(
      Combine(poor.basis.Units(400, .05), poor.numbers),
      5 * design.options.torque_noise.cwiseAbs2().cwiseInverse());
  const MatrixXd known = information.A();
  const double goal = design.Worst(known) - std::log(2.);
  const auto needs = [&](const MatrixXd& before) {
    design.all.known = before;
    for (const double duration : {1., 1.5, 2., 3., 4., 6., 8., 12., 16., 24.}) {
      design.options.duration_s = duration;
      design.options.harmonics =
          std::max(5, static_cast<int>(std::lround(duration / 2)));
      const Excitation designed = DesignExcitation(design.robot, design.model,
                                                   design.all, design.options);
      if (designed.numbers.size() > 0 && design.Worst(designed) <= goal) {
        return duration;
      }
    }
    return std::numeric_limits<double>::infinity();
  };
  const double after = needs(known);
  const double fresh = needs(0 * known);
  std::printf(
      "half the largest standard deviation: %.3g s after the log, "
      "%.3g s without it\n",
      after, fresh);
  EXPECT_LE(after, fresh / 2);
}

}  // namespace
}  // namespace armcal
