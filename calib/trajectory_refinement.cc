#include "calib/trajectory_refinement.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "calib/calibration_model.h"
#include "calib/residual_whiteness.h"
#include "calib/robust_rows.h"
#include "calib/score_covariance.h"
#include "calib/trajectory_correction.h"

namespace armcal {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Standard deviation of what is believed of a fitted width's logarithm beyond
// the data, which may not see it at all.
constexpr double kLogWidthPrior = 1;
constexpr int kSteps = 3;  // of the splines, in a pass
constexpr int kMostPasses = 8;
constexpr double kSettledMove = 0.05;   // standard deviations
constexpr double kSettledNoise = 0.01;  // relative
constexpr double kLeastEncoder = 1e-12, kLeastTorque = 1e-12;
constexpr double kHuberMeanSquare = 0.7102;  // of psi, for normal errors
constexpr double kBlock = 0.25;              // s, for the test of whiteness

// Directions of the border that the start has seen, each as large as its
// standard deviation there: seen * (anything) is a step.
MatrixXd SeenDirections(const MatrixXd& covariance, int widths) {
  const VectorXd scale = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const VectorXd unscale =
      (scale.array() > 0)
          .select(scale.cwiseInverse(), VectorXd::Zero(scale.size()));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      unscale.asDiagonal() * covariance * unscale.asDiagonal());
  const VectorXd& value = eigen.eigenvalues();
  const Eigen::Index m = scale.size();
  const Eigen::Index rank = (value.array() > 1e-12 * value[m - 1]).count();
  MatrixXd seen = MatrixXd::Zero(m + widths, rank + widths);
  seen.topLeftCorner(m, rank) = scale.asDiagonal() *
                                eigen.eigenvectors().rightCols(rank) *
                                value.tail(rank).cwiseSqrt().asDiagonal();
  seen.bottomRightCorner(widths, widths).diagonal().setConstant(kLogWidthPrior);
  return seen;
}

// The inverse of an information matrix within the seen directions.
MatrixXd InverseWithin(const MatrixXd& seen, const MatrixXd& information) {
  const MatrixXd inner = seen.transpose() * information * seen;
  return seen * inner.llt().solve(seen.transpose());
}

// Standard deviations of noise from what residuals say, in units of a guess;
// `spent`: the share of degrees of freedom that the border took.
ArrayXd NoiseFactor(const NoiseSums& sums, double spent, double efficiency) {
  const ArrayXd degrees =
      ((1 - spent) * (sums.count - sums.fitted)).max(0.05 * sums.count);
  return (sums.squares / (efficiency * degrees.max(1))).sqrt().max(1e-9);
}

// What a pass over the logs gathers about the present estimate.
struct Gathered {
  Gathered(int border, int n)
      : information(MatrixXd::Zero(border, border)),
        gradient(VectorXd::Zero(border)),
        encoder(n),
        torque(n) {}
  MatrixXd information;
  VectorXd gradient;
  NoiseSums encoder, torque;
  bool failed = false;
};

class Refinement {
 public:
  Refinement(const Robot& robot, const LinearCalibrationOptions& options,
             LogSet* logs, TrajectoryRefinement* result);

  // Improves the estimate until it stays; false, with the reason, where that
  // cannot be done.
  bool Run();
  void SetCovariance();

 private:
  using Visit = std::function<void(TrajectoryCorrection*)>;

  LinearCalibration& calibration() { return result_->calibration; }
  int size() const { return static_cast<int>(seen_.rows()); }
  TrajectoryNoise NoiseOf(int log);
  void ForEachStretch(const std::string& stage,
                      const std::function<void(int, TrajectoryCorrection*)>&);
  Gathered Gather(const std::string& stage, TorqueWeighting weighting,
                  const Visit& visit);
  void GuessNoise();
  double UpdateNoise(const Gathered& pass);
  double Step(const Gathered& pass);
  void SetWidths();
  MatrixXd LongRunCovariance(double rho, const MatrixXd& white);

  const Robot& robot_;
  const LinearCalibrationOptions& options_;
  LogSet* logs_;
  TrajectoryRefinement* result_;
  TorqueWeighting weighting_ = TorqueWeighting::kSquared;
  MatrixXd seen_;
  VectorXd log_width_;                          // change since the start
  std::vector<CoulombTransition> transitions_;  // of the start
  std::vector<bool> frozen_;                    // joints that no log powers
  TrajectoryNoise noise_;
};

Refinement::Refinement(const Robot& robot,
                       const LinearCalibrationOptions& options, LogSet* logs,
                       TrajectoryRefinement* result)
    : robot_(robot), options_(options), logs_(logs), result_(result) {
  if (options.loss == Loss::kHuber &&
      calibration().solver == LinearSolver::kWeighted) {
    weighting_ = TorqueWeighting::kHuber;
  }
  transitions_ = calibration().transitions;
  log_width_.setZero(options.transition ? 0 : transitions_.size());
  seen_ = SeenDirections(calibration().independent_covariance,
                         static_cast<int>(log_width_.size()));
  std::vector<int> unpowered(robot.num_joints(), 0);
  for (const UnpoweredJoint& u : calibration().unpowered) ++unpowered[u.joint];
  for (const int logs_of_joint : unpowered) {
    frozen_.push_back(logs_of_joint == logs->size());
  }
}

TrajectoryNoise Refinement::NoiseOf(int log) {
  TrajectoryNoise noise = noise_;
  for (int j = 0; j < robot_.num_joints(); ++j) {
    if (calibration().used[log][j]) continue;
    noise.torque[j] = std::numeric_limits<double>::infinity();
  }
  return noise;
}

void Refinement::ForEachStretch(
    const std::string& stage,
    const std::function<void(int, TrajectoryCorrection*)>& visit) {
  std::vector<TrajectoryCorrection> corrections(
      logs_->size(),
      TrajectoryCorrection(calibration().parameters, result_->knot_s));
  logs_->ForEach(stage, options_.progress, [&](int log, const Trajectory& t) {
    if (corrections[log].Enter(t)) visit(log, &corrections[log]);
  });
  ++result_->passes;
}

// From the splines of the positions alone, and the start's torques.
void Refinement::GuessNoise() {
  const int n = robot_.num_joints();
  TrajectoryNoise unit;
  unit.encoder = unit.torque = ArrayXd::Ones(n);
  ArrayXd squares = ArrayXd::Zero(n);
  double degrees = 0;
  std::vector<ResidualStatistics> torque(n);
  ForEachStretch("noise", [&](int, TrajectoryCorrection* stretch) {
    const MatrixXd e = stretch->PositionErrors();
    squares += e.colwise().squaredNorm().transpose().array();
    degrees += static_cast<double>(e.rows() - stretch->num_points());
    stretch->Fit(calibration().x, unit, TorqueWeighting::kSquared, 0);
    for (const auto& row : stretch->torque_residuals().rowwise()) {
      for (int j = 0; j < n; ++j) torque[j].Add(row[j]);
    }
  });
  noise_.encoder = (squares / std::max(1.0, degrees)).sqrt().max(kLeastEncoder);
  noise_.torque.resize(n);
  for (int j = 0; j < n; ++j) {
    noise_.torque[j] = std::max(kLeastTorque, torque[j].RobustSpread());
  }
}

Gathered Refinement::Gather(const std::string& stage, TorqueWeighting weighting,
                            const Visit& visit) {
  Gathered pass(0, robot_.num_joints());
  ForEachStretch(stage, [&](int log, TrajectoryCorrection* stretch) {
    if (pass.gradient.size() == 0) {
      const int border = stretch->border();
      pass.information.setZero(border, border);
      pass.gradient.setZero(border);
    }
    if (!stretch->Fit(calibration().x, NoiseOf(log), weighting, kSteps)) {
      pass.failed = true;
      return;
    }
    stretch->Eliminate(&pass.information, &pass.gradient, &pass.encoder,
                       &pass.torque);
    if (visit) visit(stretch);
  });
  pass.failed |= pass.gradient.size() == 0;
  if (pass.failed) return pass;
  // Widths that are given have no unknown.
  pass.information = pass.information.topLeftCorner(size(), size()).eval();
  pass.gradient = pass.gradient.head(size()).eval();
  const Eigen::Index widths = log_width_.size();
  pass.information.diagonal().tail(widths).array() +=
      1 / (kLogWidthPrior * kLogWidthPrior);
  pass.gradient.tail(widths) -= log_width_ / (kLogWidthPrior * kLogWidthPrior);
  return pass;
}

// The largest change, relative.
double Refinement::UpdateNoise(const Gathered& pass) {
  const double samples = std::max(1.0, pass.torque.count.sum());
  const double spent = std::min(0.9, static_cast<double>(size()) / samples);
  const bool huber = weighting_ == TorqueWeighting::kHuber;
  const ArrayXd encoder = NoiseFactor(pass.encoder, 0, 1);
  ArrayXd torque =
      NoiseFactor(pass.torque, spent, huber ? kHuberMeanSquare : 1);
  for (int j = 0; j < torque.size(); ++j) {
    if (frozen_[j] || pass.torque.count[j] == 0) torque[j] = 1;
  }
  noise_.encoder = (noise_.encoder * encoder).max(kLeastEncoder);
  noise_.torque = (noise_.torque * torque).max(kLeastTorque);
  noise_.mean_slope = pass.torque.slope / pass.torque.count.max(1);
  noise_.mean_square =
      pass.torque.squares /
      ((1 - spent) * (pass.torque.count - pass.torque.fitted)).max(1);
  if (!huber)
    noise_.mean_slope = noise_.mean_square = ArrayXd::Ones(torque.size());
  return std::max(encoder.log().abs().maxCoeff(),
                  torque.log().abs().maxCoeff());
}

// The largest move, in standard deviations.
double Refinement::Step(const Gathered& pass) {
  const MatrixXd inverse = InverseWithin(seen_, pass.information);
  const VectorXd change = inverse * pass.gradient;
  const Eigen::Index widths = log_width_.size();
  calibration().x += change.head(size() - widths);
  log_width_ += change.tail(widths).cwiseMax(-.3).cwiseMin(.3);
  if (widths > 0) SetWidths();
  const VectorXd stddev = inverse.diagonal().cwiseSqrt().cwiseMax(1e-300);
  return change.cwiseAbs().cwiseQuotient(stddev).maxCoeff();
}

void Refinement::SetWidths() {
  Transitions transitions;
  for (size_t j = 0; j < transitions_.size(); ++j) {
    calibration().transitions[j].width =
        transitions_[j].width * std::exp(log_width_[j]);
    transitions.push_back({calibration().transitions[j]});
  }
  calibration().parameters = MakeParameters(robot_, options_, transitions);
}

bool Refinement::Run() {
  GuessNoise();
  for (int k = 0; k < kMostPasses && !result_->converged; ++k) {
    const Gathered pass = Gather("trajectories", weighting_, nullptr);
    if (pass.failed || !pass.gradient.allFinite()) {
      result_->reason = pass.failed ? "a motion's spline is not determined"
                                    : "the numbers of the logs overflow";
      return false;
    }
    const double moved = Step(pass);
    const double changed = UpdateNoise(pass);
    if (!calibration().x.allFinite()) {
      result_->reason = "the steps did not settle";
      return false;
    }
    for (int j = 0; j < robot_.num_joints(); ++j) {
      calibration().outliers.resize(robot_.num_joints());
      calibration().outliers[j] = std::lround(pass.torque.outliers[j]);
    }
    calibration().equations = std::lround(pass.torque.count.maxCoeff());
    result_->converged = moved < kSettledMove && changed < kSettledNoise;
  }
  result_->reason =
      result_->converged ? "the estimate settled" : "most passes, still moving";
  return true;
}

// That of the scores, for autocorrelated errors.
MatrixXd Refinement::LongRunCovariance(double rho, const MatrixXd& white) {
  const double dt = logs_->time_bases()[0].dt;
  const int least =
      static_cast<int>(1.5 * calibration().rows.window_s / dt) + 1;
  ScoreCovariance scores(size(),
                         BartlettWindow(rho, calibration().equations, least));
  const TorqueWeighting weighting = TorqueWeighting::kLinearised;
  Gather("covariance", weighting, [&](TrajectoryCorrection* stretch) {
    scores.Break();
    stretch->ForEachScore(
        [&](const VectorXd& score) { scores.Add(score.head(size())); });
  });
  return white * scores.Value() * white;
}

void Refinement::SetCovariance() {
  const int n = robot_.num_joints();
  ResidualWhiteness whiteness(n);
  std::vector<ResidualStatistics> statistics(n);
  const Gathered pass = Gather(
      "covariance", TorqueWeighting::kLinearised,
      [&](TrajectoryCorrection* stretch) {
        const MatrixXd& r = stretch->torque_residuals();
        whiteness.Add(
            r, std::max(4, static_cast<int>(kBlock / stretch->motion().dt)));
        for (int j = 0; j < n; ++j) {
          statistics[j].Break();
          for (const double z : r.col(j)) statistics[j].Add(z);
        }
      });
  if (pass.failed) return;
  LinearCalibration& c = calibration();
  const int m = c.parameters.size();
  const MatrixXd white = InverseWithin(seen_, pass.information);
  VectorXd factor = VectorXd::Ones(size());
  result_->whiteness = whiteness.ratio();
  c.covariance_method = "independent samples, trajectories corrected";
  if (!whiteness.IsWhite()) {
    double rho = 0;
    for (const auto& s : statistics) rho = std::max(rho, s.Autocorrelation());
    const MatrixXd long_run = LongRunCovariance(rho, white);
    factor =
        (long_run.diagonal().array() / white.diagonal().array()).max(1).sqrt();
    factor = factor.array().isFinite().select(factor, 1);
    c.covariance_method =
        "long-run covariance of the scores, trajectories corrected";
  }
  c.independent_covariance = white.topLeftCorner(m, m);
  c.covariance = factor.head(m).asDiagonal() * c.independent_covariance *
                 factor.head(m).asDiagonal();
  for (int k = 0; k < m; ++k) {
    if (c.identifiable[k]) c.stddev[k] = std::sqrt(c.covariance(k, k));
  }
  std::nth_element(factor.begin(), factor.begin() + m / 2, factor.begin() + m);
  c.inflation = factor[m / 2];
  c.noise = noise_.torque;
  result_->encoder_noise = noise_.encoder;
}

}  // namespace

TrajectoryRefinement RefineTrajectories(const Robot& robot,
                                        const LinearCalibrationOptions& options,
                                        const LinearCalibration& start,
                                        LogSet* training, LogSet* validation) {
  TrajectoryRefinement result(start);
  if (!start.solved) {
    result.reason = start.reason;
    return result;
  }
  const double bandwidth = start.rows.bandwidth_hz > 0
                               ? start.rows.bandwidth_hz
                               : DefaultBandwidth(training->time_bases());
  result.knot_s = 0.5 / bandwidth;
  training->Prepare(0, 0);
  Refinement refinement(robot, options, training, &result);
  result.refined = refinement.Run();
  if (result.refined) refinement.SetCovariance();
  training->Prepare(start.rows.bandwidth_hz, RowReach(start.rows));
  if (!result.refined) {
    result.calibration = start;
    return result;
  }
  LinearCalibration& c = result.calibration;
  c.lengths = RecoverLengths(c.parameters, c.x, c.independent_covariance,
                             c.covariance, c.identifiable);
  const auto evaluate = [&](const std::string& stage, LogSet* logs) {
    return EvaluateTorqueResidual(c.parameters, c.x, c.rows.bandwidth_hz, stage,
                                  options.progress, logs);
  };
  c.training = evaluate("residuals", training);
  c.passes += ++result.passes;
  if (validation != nullptr) c.validation = evaluate("validation", validation);
  return result;
}

}  // namespace armcal
