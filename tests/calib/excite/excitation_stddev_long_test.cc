#include <glog/logging.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "model/plant/hidden/scenario.h"
#include "tests/calib/excite/rated_design.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/sample_motion.h"

namespace armcal::excitation_stddev_long_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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

// Standard deviations over those predicted, sorted.
struct Ratios {
  VectorXd claimed;  // by calibrations, their mean
  VectorXd scatter;  // of the calibrations themselves
  double Share(const VectorXd& ratios, double share) const {
    return ratios[std::lround(share * static_cast<double>(ratios.size() - 1))];
  }
  void Print(const char* name, int runs) const {
    const auto text = [this](const VectorXd& r) {
      char line[60];
      std::snprintf(line, sizeof line, "median %.2f (%.2f .. %.2f)",
                    Share(r, .5), r.minCoeff(), r.maxCoeff());
      return std::string(line);
    };
    std::printf(
        "%s: of %d standard deviations, claimed over predicted: %s; scatter of "
        "%d runs over predicted: %s\n",
        name, static_cast<int>(claimed.size()), text(claimed).c_str(), runs,
        text(scatter).c_str());
  }
};

class SimulatedArms : public testing::TestWithParam<const char*> {
 protected:
  static constexpr int kRuns = 24;

  SimulatedArms() : design_(GetParam()), real_(design_.robot) {
    options_.joint_terms = kTerms;
  }
  // Simbody follows the designed motion with `real_`, and calibrations of its
  // log, every time with other noise, are made with `options_`.
  Ratios Calibrate() {
    const Excitation designed = DesignExcitation(design_.robot, design_.model,
                                                 design_.all, design_.options);
    Scenario scenario;
    scenario.model = real_;
    scenario.motion = Follow(designed, 1);
    scenario.loop.controller =
        DefaultController(real_, scenario.motion.at(0).q, 10);
    scenario.loop.sensors.log_rate_hz = design_.options.rate_hz;
    const ScenarioRun run = RunScenario(scenario);
    const int m = design_.model.size();
    MatrixXd x(m, kRuns), claimed(m, kRuns);
    std::mt19937_64 random(7);
    for (int k = 0; k < kRuns; ++k) {
      Log log = run.run.log;
      AddNoise(&random, design_.options.torque_noise, &log.tau);
      const LinearCalibration result =
          CalibrateLogs(design_.robot, {log}, options_);
      CHECK(result.solved) << result.reason;
      CHECK_EQ(result.x.size(), m);
      x.col(k) = result.x;
      claimed.col(k) = result.stddev;
    }
    const MatrixXd errors = x.colwise() - x.rowwise().mean();
    const VectorXd scatter =
        (errors.rowwise().squaredNorm() / (kRuns - 1)).cwiseSqrt();
    const auto sorted = [&](const VectorXd& stddev) {
      VectorXd ratio = stddev.cwiseQuotient(designed.stddev);
      std::sort(ratio.begin(), ratio.end());
      return ratio;
    };
    const Ratios ratios{sorted(claimed.rowwise().mean()), sorted(scatter)};
    ratios.Print(GetParam(), kRuns);
    return ratios;
  }

  RatedDesign design_;
  Robot real_;
  LinearCalibrationOptions options_;
};

INSTANTIATE_TEST_SUITE_P(Arms, SimulatedArms,
                         testing::Values("scara", "puma", "ur5", "panda"));

// An arm that is as the design has it: every standard deviation is as
// predicted. Its dry friction is nil, because the plant's has another law at
// standstill than the model.
TEST_P(SimulatedArms, CalibrationsAreAsCertainAsPredicted) {
  for (Link& link : real_.links) link.joint.coulomb = 0;
  options_.transition = {CoulombTransition::Law::kVelocity, .05};
  const Ratios ratios = Calibrate();
  EXPECT_GT(ratios.claimed.minCoeff(), .8);
  EXPECT_LT(ratios.claimed.maxCoeff(), 1.2);
  EXPECT_NEAR(ratios.Share(ratios.scatter, .5), 1, .2);
}

// An arm whose dry friction turns over within 1 mrad/s, by a law that the model
// does not have: what calibrations scatter by is still as predicted. They claim
// more, for rows about standstill fit worse than noise lets them.
TEST_P(SimulatedArms, CalibrationsScatterAsPredicted) {
  const Ratios ratios = Calibrate();
  EXPECT_GT(ratios.Share(ratios.claimed, .5), .8);
  EXPECT_LT(ratios.Share(ratios.claimed, .5), 2);
  EXPECT_NEAR(ratios.Share(ratios.scatter, .5), 1, .2);
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

}  // namespace armcal::excitation_stddev_long_test
