#include "calib/refine/trajectory_refinement.h"

#include <cmath>
#include <optional>
#include <vector>

#include "calib/linear/calibration_model.h"
#include "calib/refine/trajectory_covariance.h"
#include "calib/refine/trajectory_pass.h"
#include "model/signals/bandwidth.h"
#include "model/signals/dense_solvers.h"
#include "problems/make_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr char kLostToRounding[] =
    "the torques are so exact beside the positions that rounding decides";

// The directions that the start has seen, V with V V' = covariance, each as
// large as its standard deviation there: in them the problem is well scaled.
// Eigenvectors are of the correlations, as those of the covariance would depend
// on units; eigenvalues below 1e-12 of the largest are rounding. Widths are a
// direction each.
MatrixXd SeenDirections(const MatrixXd& covariance, Eigen::Index widths) {
  const Eigen::Index m = covariance.rows();
  const VectorXd scale = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  VectorXd unscale = VectorXd::Zero(m);
  for (Eigen::Index k = 0; k < m; ++k) {
    if (scale[k] > 0) unscale[k] = 1 / scale[k];
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      unscale.asDiagonal() * covariance * unscale.asDiagonal());
  const VectorXd& value = eigen.eigenvalues();  // ascending
  const Eigen::Index rank = (value.array() > 1e-12 * value[m - 1]).count();
  MatrixXd seen = MatrixXd::Zero(m + widths, rank + widths);
  seen.topLeftCorner(m, rank) = scale.asDiagonal() *
                                eigen.eigenvectors().rightCols(rank) *
                                value.tail(rank).cwiseSqrt().asDiagonal();
  seen.bottomRightCorner(widths, widths).setIdentity();
  return seen;
}

// Joints that no log powers: their equations are homogeneous, and their noise
// must not follow the parameters down to zero.
std::vector<bool> Frozen(const LinearCalibration& start, int num_logs) {
  std::vector<int> unpowered(start.parameters.num_joints(), 0);
  for (const UnpoweredJoint& u : start.unpowered) ++unpowered[u.joint];
  std::vector<bool> frozen;
  for (const int logs : unpowered) frozen.push_back(logs == num_logs);
  return frozen;
}

class Refinement {
 public:
  Refinement(const Robot& robot, const LinearCalibrationOptions& options,
             const PreparedLogs& logs, TrajectoryRefinement* result)
      : robot_(robot),
        options_(options),
        start_(result->calibration),
        result_(result),
        pass_(result->knot_s, options.progress, logs),
        estimate_{
            start_.parameters,
            start_.x,
            VectorXd::Zero(options.transition ? 0 : start_.transitions.size()),
            {},
            start_.used,
            Frozen(start_, logs.size())},
        seen_(SeenDirections(start_.independent_covariance,
                             estimate_.log_width.size())) {
    estimate_.noise = GuessTrajectoryNoise(estimate_, &pass_);
  }

  // Improves the estimate until it stays; false, with the reason, where that
  // cannot be done.
  bool Run();
  bool Report();  // likewise

 private:
  std::optional<double> Step(const TrajectoryEquations& equations);
  void SetWidths();

  const Robot& robot_;
  const LinearCalibrationOptions& options_;
  const LinearCalibration start_;
  TrajectoryRefinement* result_;
  TrajectoryPass pass_;
  TrajectoryEstimate estimate_;
  MatrixXd seen_;
  std::vector<CoulombTransition> transitions_ = start_.transitions;
  VectorXd outliers_;
};

// One Gauss-Newton step in x and the log widths. Returns the largest move, in
// standard deviations; nothing where there is no step. Widths move by 30 % at
// most, since the torque is far from linear in them.
std::optional<double> Refinement::Step(const TrajectoryEquations& equations) {
  const std::optional<MatrixXd> inverse =
      InverseWithin(seen_, equations.information);
  if (!inverse) return std::nullopt;
  const VectorXd change = *inverse * equations.gradient;
  const Eigen::Index widths = estimate_.log_width.size();
  estimate_.x += change.head(estimate_.x.size());
  estimate_.log_width += change.tail(widths).cwiseMax(-.3).cwiseMin(.3);
  if (widths > 0) SetWidths();
  const VectorXd stddev = inverse->diagonal().cwiseSqrt().cwiseMax(1e-300);
  return change.cwiseAbs().cwiseQuotient(stddev).maxCoeff();
}

void Refinement::SetWidths() {
  Transitions all;
  for (size_t j = 0; j < transitions_.size(); ++j) {
    transitions_[j].width =
        start_.transitions[j].width * std::exp(estimate_.log_width[j]);
    all.push_back({transitions_[j]});
  }
  estimate_.parameters = MakeParameters(robot_, options_, all);
}

// Alternates steps with re-estimated noise until both stay.
bool Refinement::Run() {
  constexpr int kMostPasses = 12;
  constexpr double kSettledMove = 0.05;   // standard deviations
  constexpr double kSettledNoise = 0.02;  // relative
  const bool huber =
      options_.loss.value_or(RobustLoss::kHuber) != RobustLoss::kSquared;
  for (int k = 0; k < kMostPasses && !result_->converged; ++k) {
    const TrajectoryEquations equations = pass_.Gather(
        "trajectories", estimate_,
        huber ? TorqueWeighting::kHuber : TorqueWeighting::kSquared, nullptr);
    if (equations.failed) {
      result_->reason = "the splines of the motions are not determined";
      return false;
    }
    const std::optional<double> moved = Step(equations);
    if (!moved) {
      result_->reason = kLostToRounding;
      return false;
    }
    const double changed = UpdateTrajectoryNoise(equations, huber, &estimate_);
    if (!estimate_.x.allFinite() || !std::isfinite(changed)) {
      result_->reason = "the numbers of the logs overflow";
      return false;
    }
    outliers_ = equations.torque.outliers;
    result_->converged = *moved < kSettledMove && changed < kSettledNoise;
  }
  result_->reason =
      result_->converged ? "the estimate settled" : "most passes done";
  return true;
}

// Newey-West's window is at least 1.5 windows of the weak rows that the start
// was found with. What wrong torque constants add is the start's.
bool Refinement::Report() {
  const auto covariance = EstimateTrajectoryCovariance(
      estimate_, seen_, 1.5 * start_.rows.window_s, &pass_);
  if (!covariance) {
    result_->converged = false;
    result_->reason = kLostToRounding;
    return false;
  }
  LinearCalibration& c = result_->calibration;
  c.parameters = estimate_.parameters;
  c.transitions = transitions_;
  c.x = estimate_.x;
  c.covariance = covariance->estimate.covariance + c.scale_covariance;
  c.covariance_method =
      covariance->estimate.method + ", trajectories corrected";
  c.independent_covariance = covariance->independent;
  c.inflation = covariance->inflation;
  for (int k = 0; k < c.parameters.size(); ++k) {
    if (c.identifiable[k]) c.stddev[k] = std::sqrt(c.covariance(k, k));
  }
  c.noise = estimate_.noise.torque;
  c.encoder_noise = estimate_.noise.encoder;
  c.outliers.clear();
  for (const double o : outliers_) c.outliers.push_back(std::lround(o));
  c.passes += pass_.passes();
  c.lengths = RecoverLengths(c.parameters, c.x, c.independent_covariance,
                             c.covariance, c.identifiable);
  return true;
}

}  // namespace

// Knots half a period of the bandwidth apart let splines follow the motion that
// the bandwidth passes and no more (the sampling theorem); closer ones would
// follow the noise.
TrajectoryRefinement RefineTrajectories(const Robot& robot,
                                        const LinearCalibrationOptions& options,
                                        const LinearCalibration& start,
                                        const LogSet& training,
                                        const LogSet* validation) {
  TrajectoryRefinement result{start, false, false, start.reason, 0};
  if (!start.solved) return result;
  const double bandwidth = start.rows.bandwidth_hz > 0
                               ? start.rows.bandwidth_hz
                               : DefaultBandwidth(training.time_bases());
  result.knot_s = 0.5 / bandwidth;
  // Positions as they are: what a filter leaves of their noise is not white.
  Refinement refinement(robot, options, Prepare(training, {}), &result);
  result.refined = refinement.Run() && refinement.Report();
  if (!result.refined) return result;
  LinearCalibration& c = result.calibration;
  // Gross errors of the torque count by the loss, and none was taken out.
  c.preparation = PreparationForRows(c.rows);
  const auto evaluate = [&](const std::string& stage, const LogSet& logs) {
    return EvaluateTorqueResidual(c.parameters, c.x, c.rows.bandwidth_hz, stage,
                                  options.progress,
                                  Prepare(logs, PreparationForRows(c.rows)));
  };
  c.training = evaluate("residuals", training);
  ++c.passes;
  if (validation != nullptr) {
    c.validation = evaluate("validation", *validation);
  }
  return result;
}

}  // namespace armcal
