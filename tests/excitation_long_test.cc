#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "calib/design_target.h"
#include "calib/excitation.h"
#include "model/plant/hidden/scenario.h"
#include "tests/calibrate_logs.h"
#include "tests/rated_arms.h"
#include "tests/sample_motion.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::vector<JointTerm> kTerms = {JointTerm::kViscous, JointTerm::kCoulomb,
                                       JointTerm::kOffset,
                                       JointTerm::kArmature};

// 20 s of an arm within its maker's limits, torques with 1 % of noise.
struct RatedDesign {
  explicit RatedDesign(const std::string& name)
      : robot(RatedArm(name)), model(robot, ModelOptions(robot)) {
    std::vector<std::string> assumed;
    options.limits = LimitsOf(robot, &assumed);
    const int n = robot.num_joints(), m = model.size();
    const ReferenceScale reference = MakeReferenceScale(
        model, 1, .5, 1, VectorXd::Zero(n), model.Values(robot));
    options.torque_noise = .01 * reference.torque;
    all = MakeDesignQuantities(robot, model, kTerms, DesignTarget::kModel, {},
                               reference, MatrixXd::Zero(m, m))
              .design;
  }

  static ModelParameters::Options ModelOptions(const Robot& robot) {
    ModelParameters::Options options;
    options.joint_terms = kTerms;
    options.transitions.assign(robot.num_joints(),
                               {{CoulombTransition::Law::kVelocity, .05}});
    return options;
  }

  // The best of 1000 random motions by each criterion; logarithms.
  struct Best {
    double volume = std::numeric_limits<double>::infinity();
    double worst = std::numeric_limits<double>::infinity();
  };
  Best OfRandom() const {
    MotionInformation information(robot, model);
    const HarmonicBasis basis(options.duration_s, options.harmonics);
    const int samples = 16 * options.harmonics;
    const Motion units = basis.Units(samples, options.duration_s / samples);
    const VectorXd weight = options.torque_noise.cwiseAbs2().cwiseInverse() *
                            (options.duration_s * options.rate_hz / samples);
    Best best;
    for (int k = 0; k < 1000; ++k) {
      const MatrixXd numbers =
          RandomNumbers(basis, units, {options.limits, &options.workspace},
                        model.Values(robot), 900'000'000 + k, &information);
      if (numbers.size() == 0) continue;
      information.Evaluate(Combine(units, numbers), weight);
      MatrixXd gradient;
      const auto volume = EvaluateCriterion(ExcitationCriterion::kD, all,
                                            information.A(), &gradient);
      if (!volume) continue;
      best.volume = std::min(best.volume, *volume);
      best.worst = std::min(best.worst, Worst(information.A()));
    }
    return best;
  }
  // The logarithm of the largest relative standard deviation.
  double Worst(const MatrixXd& A) const {
    const VectorXd stddev = PredictedStddev(all, A)(all.wanted);
    return std::log(stddev.cwiseQuotient(all.scale).maxCoeff());
  }
  double Worst(const Excitation& designed) const {
    const VectorXd stddev = designed.stddev(all.wanted);
    return std::log(stddev.cwiseQuotient(all.scale).maxCoeff());
  }

  // No motion has a smaller largest standard deviation: viscous and Coulomb
  // friction of a joint are the slope and the intercept of a line over speeds
  // from 0 to the limit, which samples at its two ends tell best (a share w of
  // them at 0), were all else known.
  double LeastWorst() const {
    VectorXd slope = VectorXd::Zero(robot.num_joints()), intercept = slope;
    const double samples = options.duration_s * options.rate_hz;
    for (int k = 0; k < model.size(); ++k) {
      const ModelParameter& p = model.parameters()[k];
      if (!p.is_joint_term) continue;
      const double unit =
          options.torque_noise[p.block] / std::sqrt(samples) / all.scale[k];
      if (p.term == JointTerm::kViscous) {
        slope[p.block] = unit / options.limits.velocity[p.block];
      }
      if (p.term == JointTerm::kCoulomb) intercept[p.block] = unit;
    }
    double least = 0;
    for (int j = 0; j < robot.num_joints(); ++j) {
      double of_joint = std::numeric_limits<double>::infinity();
      for (double w = .01; w < 1; w += .01) {
        of_joint =
            std::min(of_joint, std::max(intercept[j] / std::sqrt(w),
                                        slope[j] / std::sqrt(w * (1 - w))));
      }
      least = std::max(least, of_joint);
    }
    return least;
  }

  Robot robot;
  ModelParameters model;
  DesignQuantities all;
  ExcitationOptions options;
};

class RatedArms : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Arms, RatedArms,
                         testing::Values("scara", "puma", "ur5", "panda"));

// The volume's ratio is of its m-th root: how much smaller variances are on
// average.
TEST_P(RatedArms, DesignsBeatTheBestOfAThousandRandomMotions) {
  using Clock = std::chrono::steady_clock;
  RatedDesign design(GetParam());
  const RatedDesign::Best random = design.OfRandom();
  double seconds = 0;
  const auto run = [&](ExcitationCriterion criterion) {
    design.options.criterion = criterion;
    const Clock::time_point start = Clock::now();
    const Excitation designed = DesignExcitation(design.robot, design.model,
                                                 design.all, design.options);
    seconds = std::max(
        seconds, std::chrono::duration<double>(Clock::now() - start).count());
    EXPECT_LE(designed.used, 1);
    return designed;
  };
  const Excitation by_volume = run(ExcitationCriterion::kD);
  const Excitation by_worst = run(ExcitationCriterion::kWorst);
  const double volume = std::exp(2 * (by_volume.criterion - random.volume));
  const double worst = std::exp(design.Worst(by_worst) - random.worst);
  const double least = design.LeastWorst() / std::exp(random.worst);
  std::printf(
      "%s: %d parameters, variance %.2f (det^(1/m); determinant 10^%.0f), "
      "worst standard deviation %.2f times the best of 1000 (no motion can: "
      "%.2f), %.0f s; limits used %.4f and %.4f\n",
      GetParam(), design.model.size(), volume,
      design.model.size() * std::log10(volume), worst, least, seconds,
      by_volume.used, by_worst.used);
  EXPECT_LT(volume, .6);
  // Where limits of velocity leave little room for that, near what they leave.
  EXPECT_LT(worst, std::max(.6, 1.8 * least));
}

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

// Simbody follows the motion; what calibrations of its logs scatter by, and
// what they say that they do, is what was predicted.
TEST_P(RatedArms, CalibrationsAreAsCertainAsPredicted) {
  RatedDesign design(GetParam());
  const Excitation designed =
      DesignExcitation(design.robot, design.model, design.all, design.options);
  Scenario scenario;
  scenario.model = design.robot;
  scenario.motion = Follow(designed, 1);
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
  EXPECT_NEAR(said[m / 2], 1, .2);
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
