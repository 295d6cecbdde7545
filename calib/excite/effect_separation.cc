#include "calib/excite/effect_separation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "model/dynamics/recorded_torque.h"
#include "problems/motion_design.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRate = 50;     // Hz, at which effects are followed
constexpr int kMostSteps = 120;  // that the best random motion is improved by
constexpr double kFirstStep = .15;  // of the motion's size

// The information about model parameters and sizes together.
class Overlap {
 public:
  Overlap(const Robot& robot, const ModelParameters& model,
          const SeparationQuestion& question, const MatrixXd& known,
          const VectorXd& weight)
      : robot_(robot),
        question_(question),
        known_(known),
        weight_(weight),
        information_(robot, model) {}

  MatrixXd At(const Motion& motion) {
    const long m = known_.rows();
    const long k = static_cast<long>(question_.columns.size());
    information_.Evaluate(motion, weight_);
    MatrixXd A(m + k, m + k);
    A.topLeftCorner(m, m) = information_.A() + known_;
    const std::vector<MatrixXd> columns = Columns(motion);
    for (long c = 0; c < k; ++c) {
      A.col(m + c).head(m) = information_.Project(columns[c], weight_);
      for (long d = 0; d <= c; ++d) {
        A(m + d, m + c) = A(m + c, m + d) =
            (columns[c].cwiseProduct(columns[d]) * weight_).sum();
      }
    }
    A.bottomLeftCorner(k, m) = A.topRightCorner(m, k).transpose();
    return A;
  }

 private:
  // Of each size: the torque that it adds, samples x joints.
  std::vector<MatrixXd> Columns(const Motion& motion) const {
    const std::vector<CoulombTransition> transitions(
        robot_.num_joints(),
        {CoulombTransition::Law::kVelocity, question_.scale.width[0]});
    RecordedTorque torque(robot_, transitions, motion);
    std::vector<MatrixXd> columns;
    for (const auto& column : question_.columns) {
      SimulatedRobot changed;
      changed.robot = robot_;
      column.effect->apply({&robot_, column.joint, &question_.scale}, column.p,
                           &changed);
      columns.push_back(torque.Change(changed));
    }
    return columns;
  }

  const Robot& robot_;
  const SeparationQuestion& question_;
  const MatrixXd& known_;
  VectorXd weight_;
  MotionInformation information_;
};

// Standard deviations of the last `k` of the unknowns, with all unknown and
// with the other sizes known; infinite where open.
struct Certainty {
  VectorXd together, alone;
};

Certainty CertaintyOf(const MatrixXd& information, long k) {
  constexpr double kLeastShare = 1e-6;  // that the model must leave of a column
  const long m = information.rows() - k;
  const VectorXd unit = information.diagonal().unaryExpr(
      [](double x) { return x > 0 ? 1 / std::sqrt(x) : 1; });
  MatrixXd A = unit.asDiagonal() * information * unit.asDiagonal();
  A.diagonal().head(m).array() += 1e-10;  // what nothing shows of the model
  const MatrixXd left =
      A.bottomRightCorner(k, k) -
      A.bottomLeftCorner(k, m) *
          A.topLeftCorner(m, m).ldlt().solve(A.topRightCorner(m, k));
  Certainty certainty{VectorXd::Constant(k, INFINITY),
                      VectorXd::Constant(k, INFINITY)};
  for (long c = 0; c < k; ++c) {
    if (left(c, c) > kLeastShare) {
      certainty.alone[c] = unit[m + c] / std::sqrt(left(c, c));
    }
  }
  const Eigen::LLT<MatrixXd> factor(left);
  if (factor.info() != Eigen::Success || !certainty.alone.allFinite()) {
    return certainty;
  }
  const VectorXd variance = factor.solve(MatrixXd::Identity(k, k)).diagonal();
  for (long c = 0; c < k; ++c) {
    if (variance[c] > 0 && variance[c] * kLeastShare < 1) {
      certainty.together[c] = unit[m + c] * std::sqrt(variance[c]);
    }
  }
  return certainty;
}

class Separator {
 public:
  Separator(const Robot& robot, const ModelParameters& model,
            const SeparationQuestion& question, const MatrixXd& known,
            const ExcitationOptions& options)
      : question_(question),
        options_(options),
        x_(model.Values(robot)),
        bounds_{options.limits.Within(.97), &options.workspace, .01},
        overlap_(robot, model, question, known,
                 options.torque_noise.cwiseAbs2().cwiseInverse() *
                     (options.periods * options.rate_hz / kRate)),
        information_(robot, model) {
    const double period = options.duration_s / options.periods;
    result_.motion.basis = HarmonicBasis(period, options.harmonics);
    units_ = result_.motion.basis.Units(
        static_cast<int>(std::lround(period * kRate)), 1 / kRate);
  }

  EffectSeparation Run() {
    Start();
    if (result_.motion.numbers.size() == 0) {
      result_.motion.reason = "no motion within the limits tells them apart";
      return result_;
    }
    result_.motion.start = value_;
    Improve();
    Describe();
    return result_;
  }

 private:
  std::optional<double> Value(const MatrixXd& numbers) {
    const VectorXd stddev = Certain(numbers).together;
    const double worst = stddev.maxCoeff();
    return std::isfinite(worst) && worst > 0 ? std::optional(std::log(worst))
                                             : std::nullopt;
  }
  Certainty Certain(const MatrixXd& numbers) {
    return CertaintyOf(overlap_.At(Combine(units_, numbers)),
                       static_cast<long>(question_.columns.size()));
  }

  void Start() {
    for (int k = 0; k < options_.starts; ++k) {
      Tell(.5 * k / options_.starts);
      const MatrixXd numbers =
          RandomNumbers(result_.motion.basis, units_, bounds_, x_,
                        options_.seed * 1000003 + k, &information_);
      if (numbers.size() > 0) Keep(numbers);
    }
  }

  // Steps become longer where they help and shorter where not (a (1+1)
  // evolution strategy with the one-fifth rule).
  void Improve() {
    std::mt19937_64 random(options_.seed);
    std::normal_distribution<double> normal;
    double step = kFirstStep;
    for (int k = 0; k < kMostSteps; ++k) {
      Tell(.5 + .5 * k / kMostSteps);
      MatrixXd numbers = result_.motion.numbers;
      const VectorXd size =
          (numbers.bottomRows(numbers.rows() - 1).colwise().norm() /
           std::sqrt(numbers.rows() - 1.))
              .transpose();
      for (Eigen::Index j = 0; j < numbers.cols(); ++j) {
        const double range = bounds_.limits.upper[j] - bounds_.limits.lower[j];
        numbers(0, j) += .2 * step * range * normal(random);
        for (Eigen::Index i = 1; i < numbers.rows(); ++i) {
          numbers(i, j) += step * size[j] * normal(random);
        }
      }
      if (!ShrinkWaves(units_, bounds_, x_, .97, &information_, &numbers)) {
        continue;
      }
      step *= Keep(numbers) ? 1.5 : .9;
      ++result_.motion.iterations;
    }
  }

  bool Keep(const MatrixXd& numbers) {
    const std::optional<double> value = Value(numbers);
    if (!value || *value >= value_) return false;
    value_ = *value;
    result_.motion.numbers = numbers;
    return true;
  }

  void Describe() {
    Excitation& motion = result_.motion;
    motion.criterion = value_;
    motion.converged = true;
    motion.reason = "as many random steps as were to be tried";
    CheckBounds(options_, x_, &information_, &motion);
    const Certainty certainty = Certain(motion.numbers);
    for (size_t c = 0; c < question_.columns.size(); ++c) {
      const auto& column = question_.columns[c];
      const auto k = static_cast<long>(c);
      const Effect& effect = *column.effect;
      const int joint = std::max(0, column.joint);
      motion.stddev.conservativeResize(k + 1);
      motion.stddev[k] = std::abs(column.size) * certainty.together[k];
      result_.sizes.push_back(
          {effect.name, column.joint, effect.parameters[column.parameter].name,
           ParameterUnit(effect.parameters[column.parameter].unit,
                         question_.joint_types[joint]),
           column.size, motion.stddev[k],
           std::abs(column.size) * certainty.alone[k]});
    }
  }

  void Tell(double share) const {
    if (options_.progress) options_.progress("designing the motion", share);
  }

  const SeparationQuestion& question_;
  const ExcitationOptions& options_;
  VectorXd x_;
  MotionBounds bounds_;
  Overlap overlap_;
  MotionInformation information_;
  Motion units_;
  double value_ = INFINITY;
  EffectSeparation result_;
};

}  // namespace

EffectSeparation SeparateEffects(const Robot& robot,
                                 const ModelParameters& model,
                                 const SeparationQuestion& question,
                                 const MatrixXd& known,
                                 const ExcitationOptions& options) {
  return Separator(robot, model, question, known, options).Run();
}

NamedQuantities SeparatedQuantities(const Robot& robot,
                                    const EffectSeparation& separation) {
  NamedQuantities all;
  const auto k = static_cast<long>(separation.sizes.size());
  all.nominal = all.design.scale = VectorXd(k);
  for (long c = 0; c < k; ++c) {
    const SeparatedSize& size = separation.sizes[static_cast<size_t>(c)];
    all.names.push_back(
        size.effect +
        (size.joint < 0 ? "" : "@" + robot.links[size.joint].joint.name) + " " +
        size.parameter);
    all.units.push_back(size.unit);
    all.nominal[c] = size.size;
    all.design.scale[c] = std::abs(size.size);
    all.design.wanted.push_back(static_cast<int>(c));
  }
  return all;
}

}  // namespace armcal
