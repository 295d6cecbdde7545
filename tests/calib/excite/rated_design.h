#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "calib/excite/design_target.h"
#include "calib/excite/excitation.h"
#include "tests/calib/excite/rated_arms.h"

namespace armcal {

inline const std::vector<JointTerm> kTerms = {
    JointTerm::kViscous, JointTerm::kCoulomb, JointTerm::kOffset,
    JointTerm::kArmature};

// 20 s of an arm within its maker's limits, torques with 1 % of noise.
struct RatedDesign {
  explicit RatedDesign(const std::string& name)
      : robot(RatedArm(name)), model(robot, ModelOptions(robot)) {
    std::vector<std::string> assumed;
    options.limits = LimitsOf(robot, &assumed);
    const int n = robot.num_joints(), m = model.size();
    const ReferenceScale reference = MakeReferenceScale(
        model, 1, .5, 1, Eigen::VectorXd::Zero(n), model.Values(robot));
    options.torque_noise = .01 * reference.torque;
    all = MakeDesignQuantities(robot, model, kTerms, DesignTarget::kModel, {},
                               reference, Eigen::MatrixXd::Zero(m, m))
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
    const Eigen::VectorXd weight =
        options.torque_noise.cwiseAbs2().cwiseInverse() *
        (options.duration_s * options.rate_hz / samples);
    Best best;
    for (int k = 0; k < 1000; ++k) {
      const Eigen::MatrixXd numbers =
          RandomNumbers(basis, units, {options.limits, &options.workspace},
                        model.Values(robot), 900'000'000 + k, &information);
      if (numbers.size() == 0) continue;
      information.Evaluate(Combine(units, numbers), weight);
      Eigen::MatrixXd gradient;
      const auto volume = EvaluateCriterion(ExcitationCriterion::kD, all,
                                            information.A(), &gradient);
      if (!volume) continue;
      best.volume = std::min(best.volume, *volume);
      best.worst = std::min(best.worst, Worst(information.A()));
    }
    return best;
  }
  // The logarithm of the largest relative standard deviation.
  double Worst(const Eigen::MatrixXd& A) const {
    const Eigen::VectorXd stddev = PredictedStddev(all, A)(all.wanted);
    return std::log(stddev.cwiseQuotient(all.scale).maxCoeff());
  }
  double Worst(const Excitation& designed) const {
    const Eigen::VectorXd stddev = designed.stddev(all.wanted);
    return std::log(stddev.cwiseQuotient(all.scale).maxCoeff());
  }

  // No motion has a smaller largest standard deviation: viscous and Coulomb
  // friction of a joint are the slope and the intercept of a line over speeds
  // from 0 to the limit, which samples at its two ends tell best (a share w of
  // them at 0), were all else known.
  double LeastWorst() const {
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(robot.num_joints()),
                    intercept = slope;
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

}  // namespace armcal
