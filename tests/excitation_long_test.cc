#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "calib/design_target.h"
#include "calib/excitation.h"
#include "tests/rated_arms.h"

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
          RandomNumbers(basis, units, options.limits, model.Values(robot),
                        900'000'000 + k, &information);
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
  std::printf(
      "%s: %d parameters, variance %.2f (det^(1/m); determinant 10^%.0f), "
      "worst standard deviation %.2f times the best of 1000, %.0f s; limits "
      "used %.4f and %.4f\n",
      GetParam(), design.model.size(), volume,
      design.model.size() * std::log10(volume), worst, seconds, by_volume.used,
      by_worst.used);
  EXPECT_LT(volume, .6);
  EXPECT_LT(worst, .6);
}

}  // namespace
}  // namespace armcal
