#include "calib/refine/nonlinear_calibration.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/linear/calibration_model.h"
#include "calib/numerics/median.h"
#include "calib/poses/fit.h"
#include "calib/poses/pose_solution.h"
#include "calib/refine/arm_covariance.h"
#include "calib/refine/arm_fit.h"
#include "calib/refine/link_equations.h"
#include "model/dynamics/robot_lengths.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rounds of taking the torques linearly in the geometry.
constexpr int kMostRounds = 20;
constexpr double kConverged = 0.05;  // noise deviations, rms over parameters

bool HasUnknownLengths(const LinearCalibration& linear) {
  return !linear.parameters.unknown_lengths().empty();
}

// The file's robot with the lengths of the linear calibration.
Robot WithRecoveredLengths(const Robot& robot,
                           const LinearCalibration& linear) {
  std::vector<Length> lengths;
  for (size_t l = 0; l < linear.lengths.size(); ++l) {
    lengths.push_back(linear.parameters.unknown_lengths()[l]);
    lengths.back().value = linear.lengths[l].value;
  }
  return WithLengths(robot, lengths);
}

// How well each of the linear estimate's parameters is to be met. With a known
// geometry all can be. Moments times lengths are parameters of their own where
// lengths are unknown, and not all of them together with one set of lengths.
VectorXd Weights(const LinearCalibration& linear) {
  constexpr double kExact = 1e-9;  // relative error of a certain parameter
  VectorXd weights = VectorXd::Ones(linear.x.size());
  if (!HasUnknownLengths(linear)) return weights;
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    const double error = std::hypot(linear.stddev[k], kExact * linear.x[k]);
    weights[k] = linear.identifiable[k] && error > 0 ? 1 / error : 0;
  }
  return weights;
}

// Links and terms that have the linear estimate's torques: the least-norm
// solution of K (links, terms) = X, K being how the model parameters X follow
// from the robot's. They are of no body, but weights of the equations only ask
// for torques.
ArmValues LinearValues(const ArmUnknowns& unknowns,
                       const LinearCalibration& linear) {
  ArmValues values = unknowns.nominal();
  const Eigen::Index size = unknowns.tilt_begin();
  ArmValues unit = values;
  MatrixXd K(linear.parameters.size(), size);
  for (Eigen::Index k = 0; k < size; ++k) {
    unit.links.setZero();
    unit.terms.setZero();
    (k < unit.links.size() ? unit.links[k]
                           : unit.terms[k - unit.links.size()]) = 1;
    K.col(k) = linear.parameters.Values(unknowns.WithInertia(unit));
  }
  const VectorXd weights = Weights(linear);
  K = weights.asDiagonal() * K;
  const VectorXd x =
      K.completeOrthogonalDecomposition().solve(weights.cwiseProduct(linear.x));
  values.links = x.head(values.links.size());
  values.terms = x.tail(values.terms.size());
  return values;
}

// Sets the terms that the linear model has as parameters of their own.
void SetTerms(const ArmUnknowns& unknowns, const LinearCalibration& linear,
              VectorXd* terms) {
  for (int k = 0; k < linear.parameters.size(); ++k) {
    const ModelParameter& p = linear.parameters.parameters()[k];
    for (size_t t = 0; p.is_joint_term && t < unknowns.terms().size(); ++t) {
      const JointTermColumn& term = unknowns.terms()[t];
      if (term.joint != p.block || term.term != p.term) continue;
      (*terms)[static_cast<Eigen::Index>(t)] = linear.x[k];
    }
  }
}

class NonlinearCalibrator {
 public:
  NonlinearCalibrator(const Robot& robot, const LinearCalibration& linear,
                      const NonlinearCalibrationOptions& options,
                      const PoseMeasurements* poses)
      : linear_(linear),
        options_(options),
        unknowns_(robot, linear, options.refine, poses),
        noise_(EquationNoise(linear)),
        values_(unknowns_.nominal()) {
    if (poses == nullptr) return;
    pose_options_.refine = options.refine;
    pose_options_.loss = options.pose_loss;
    pose_options_.prior_length = options.trust.length;
    pose_options_.prior_angle = options.trust.angle;
    pose_fit_.emplace(robot, *poses, pose_options_);
  }

  NonlinearCalibration Run(const PoseMeasurements* poses,
                           const LogSet& training, const LogSet* validation);

 private:
  // Empty, or why not.
  std::string StartPoses(const PoseMeasurements& measured,
                         NonlinearCalibration* result);
  bool Solve(const PreparedLogs& training, const ArmFit& fit,
             NonlinearCalibration* result);
  void Report(const ArmCovariance& covariance,
              NonlinearCalibration* result) const;
  TorqueResidual Evaluate(const Robot& robot, const PreparedLogs& logs) const;

  const LinearCalibration& linear_;
  const NonlinearCalibrationOptions& options_;
  ArmUnknowns unknowns_;
  PoseCalibrationOptions pose_options_;
  std::optional<PoseFit> pose_fit_;
  VectorXd noise_;  // per joint
  ArmValues values_;
};

std::string NonlinearCalibrator::StartPoses(const PoseMeasurements& measured,
                                            NonlinearCalibration* result) {
  const PoseSolution alone = SolvePoses(measured, options_.refine, &*pose_fit_);
  values_.poses = alone.unknowns;
  result->poses.emplace();
  result->poses->before = alone.before;
  result->poses->before_rms = Rms(alone.before);
  result->poses->noise = pose_fit_->noise();
  return alone.refusal;
}

// Torques are linear in all but the geometry. In this they are taken linearly
// about the last estimate, with the noise that it leaves, round after round:
// Gauss-Newton in the geometry with all else solved to the end in each. It
// rests where a round moves the torques by less than kConverged of their noise.
bool NonlinearCalibrator::Solve(const PreparedLogs& training, const ArmFit& fit,
                                NonlinearCalibration* result) {
  LinkPass pass(unknowns_, linear_, options_.progress, training);
  // Weights of equations are then those at a robot that has the lengths.
  const bool again = unknowns_.refines_geometry() || HasUnknownLengths(linear_);
  ArmValues about = LinearValues(unknowns_, linear_);
  SetTerms(unknowns_, linear_, &values_.terms);
  for (int round = 0; round < kMostRounds; ++round) {
    const LinkEquations equations = pass.Reduce(about, noise_);
    if (round == 0) {
      // The geometry's columns are at inertias that no body has.
      if (!fit.Start(equations, &values_)) {
        result->reason = "the numbers of the logs overflow";
        return false;
      }
      if (again) {
        about = values_;
        continue;
      }
    } else {
      for (Eigen::Index i = 0; i < noise_.size(); ++i) {
        if (equations.spread[i] > 0) noise_[i] *= equations.spread[i];
      }
    }
    const ArmFit::End end = fit.Solve(equations, &values_);
    result->iterations += end.iterations;
    result->reason = end.reason;
    if (!end.usable) return false;
    if (!unknowns_.refines_geometry()) return true;
    const VectorXd moved = equations.R * (values_.Stacked() - about.Stacked());
    about = values_;
    if (moved.norm() < kConverged * std::sqrt(unknowns_.size())) return true;
  }
  result->reason = "NO_CONVERGENCE";
  return true;
}

// Parameters that only the file tells have an infinite deviation, but their
// posterior variance is in `covariance`: sums of them may be known well.
void NonlinearCalibrator::Report(const ArmCovariance& covariance,
                                 NonlinearCalibration* result) const {
  const VectorXd value = values_.Stacked();
  const VectorXd prior = unknowns_.nominal().Stacked();
  std::vector<int> shown;
  for (int k = 0; k < unknowns_.size(); ++k) {
    // A geometry that is not asked for is no result.
    const bool geometry = k >= unknowns_.tilt_begin();
    if (geometry && !unknowns_.is_free(k)) continue;
    shown.push_back(k);
    PhysicalParameter out;
    out.name = unknowns_.name(k);
    out.unit = unknowns_.unit(k);
    out.value = value[k];
    out.prior = prior[k];
    out.identifiable = covariance.identifiable[k];
    out.held = !unknowns_.is_free(k);
    out.geometry = geometry;
    out.at_bound = unknowns_.is_positive(k) &&
                   value[k] < 1e-6 * unknowns_.NormalPrior(k, options_.trust);
    out.stddev = out.identifiable ? std::sqrt(covariance.covariance(k, k))
                                  : std::numeric_limits<double>::infinity();
    result->parameters.push_back(out);
  }
  result->covariance = covariance.covariance(shown, shown);
  result->unseen = covariance.unseen;
}

// Residuals of the robot itself, by its own inverse dynamics: what a simulator
// will leave and not what the equations did.
TorqueResidual NonlinearCalibrator::Evaluate(const Robot& robot,
                                             const PreparedLogs& logs) const {
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  for (int j = 0; j < robot.num_joints(); ++j) {
    options.transitions.push_back({unknowns_.terms()[4 * j].transition});
  }
  const ModelParameters parameters(robot, options);
  return EvaluateTorqueResidual(parameters, parameters.Values(robot),
                                linear_.rows.bandwidth_hz, "residuals",
                                options_.progress, logs);
}

// Poses are solved first by themselves, for the instrument's frame and the
// noise; torques and poses then together, so that one covariance has both.
NonlinearCalibration NonlinearCalibrator::Run(const PoseMeasurements* poses,
                                              const LogSet& training,
                                              const LogSet* validation) {
  NonlinearCalibration result;
  result.robot = result.nominal = unknowns_.robot();
  result.lengths = linear_.lengths;
  result.reason = linear_.reason;
  if (!linear_.solved) return result;
  if (poses != nullptr) {
    result.reason = StartPoses(*poses, &result);
    if (!result.reason.empty()) return result;
  }
  const ArmFit fit(unknowns_, options_.trust,
                   pose_fit_ ? &*pose_fit_ : nullptr);
  const PreparedLogs prepared = Prepare(training, linear_.preparation);
  result.solved = Solve(prepared, fit, &result);
  if (!result.solved) return result;
  LinkPass pass(unknowns_, linear_, options_.progress, prepared);
  const PoseInformation told_by_poses = fit.InformByPoses(values_);
  Report(
      EstimateArmCovariance(unknowns_, fit, options_.trust, told_by_poses,
                            pass.Inform(values_, noise_, told_by_poses.rows,
                                        fit.PriorInformation(options_.trust)),
                            linear_.torque_constants_stddev),
      &result);
  result.robot = unknowns_.Apply(values_);
  result.refined_geometry =
      unknowns_.refines_geometry() || poses != nullptr ||
      std::any_of(
          result.lengths.begin(), result.lengths.end(),
          [](const RecoveredLength& l) { return l.value != l.nominal; });
  result.training = Evaluate(result.robot, prepared);
  if (validation != nullptr) {
    result.validation = Evaluate(
        result.robot, Prepare(*validation, PreparationForRows(linear_.rows)));
  }
  if (poses != nullptr) {
    const auto& distances = result.poses->after =
        pose_fit_->Distances(pose_fit_->AllRows(), values_.poses);
    result.poses->rms = Rms(distances);
    result.poses->max = *std::max_element(distances.begin(), distances.end());
  }
  return result;
}

}  // namespace

NonlinearCalibration CalibrateNonlinear(
    const Robot& robot, const LinearCalibration& linear,
    const NonlinearCalibrationOptions& options, const LogSet& training,
    const LogSet* validation, const PoseMeasurements* poses) {
  return NonlinearCalibrator(WithRecoveredLengths(robot, linear), linear,
                             options, poses)
      .Run(poses, training, validation);
}

}  // namespace armcal
