#include "calib/linear_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/log_factors.h"
#include "calib/robust_rows.h"
#include "calib/score_covariance.h"
#include "calib/transition_choice.h"
#include "model/input_error.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kReweightingPasses = 2;
constexpr int kWindowHops = 4;

// The steps of one calibration; each uses what the ones before it found.
class Calibrator {
 public:
  Calibrator(const Robot& robot, const LinearCalibrationOptions& options,
             LogSet* training, LogSet* validation)
      : robot_(robot),
        options_(options),
        training_(training),
        validation_(validation) {}

  LinearCalibration Run() {
    PrepareRows();
    const std::vector<std::vector<CoulombTransition>> transitions =
        FindTransitions();
    LinearCalibration result(MakeParameters(transitions));
    result_ = &result;
    for (const auto& t : transitions) result.transitions.push_back(t.front());
    result.bandwidth_hz = training_->bandwidth_hz();
    result.window_s = rows_.window_s;
    result.identification = options_.identification;
    result.solver = options_.solver;
    Reduce();
    SolveFromFactors();
    if (result.solved && robust()) ReweightRows();
    if (result.solved) {
      EstimateCovariance();
      RecoverGeometry();
    }
    EvaluateResiduals();
    result.passes = passes_;
    return result;
  }

 private:
  bool robust() const {
    return options_.solver == LinearSolver::kWeighted &&
           options_.loss == Loss::kHuber;
  }
  bool has_coulomb() const {
    return std::count(options_.joint_terms.begin(), options_.joint_terms.end(),
                      JointTerm::kCoulomb) > 0;
  }

  void PrepareRows();
  ModelParameters MakeParameters(
      const std::vector<std::vector<CoulombTransition>>& transitions) const;
  std::vector<std::vector<CoulombTransition>> FindTransitions();
  MatrixXd Reference(const ModelParameters& parameters,
                     const LogFactors& factors) const;
  void Reduce();
  void FindUnpowered(const LogFactors& factors);
  void CheckIntervals() const;
  void SolveFromFactors();
  void ReweightRows();
  double Autocorrelation();
  Eigen::VectorXd Score(const IdentificationRow& row,
                        const Eigen::VectorXd& r) const;
  void AccumulateScores(int window);
  void EstimateCovariance();
  void InflateByLogs(const MatrixXd& sums);
  void RecoverGeometry();
  void EvaluateResiduals();
  TorqueResidual Evaluate(const std::string& stage, LogSet* logs);
  // Calls visit(log, row, residuals in noise units) for every row; joints that
  // are left out have residual 0 and used[joint] false.
  template <class Visit>
  void ForEachResidual(const std::string& stage, const Visit& visit);

  const Robot& robot_;
  const LinearCalibrationOptions& options_;
  LogSet* training_;
  LogSet* validation_;
  LinearCalibration* result_ = nullptr;
  int passes_ = 1;  // the audit of the time base
  RowOptions rows_;
  MatrixXd reference_;
  std::vector<std::vector<bool>> powered_;  // [log][joint]
  std::vector<bool> frozen_;  // joints without any powered equations
  std::optional<BlockTriangularFactor> factor_;
  LinearSolution solution_;
};

void Calibrator::PrepareRows() {
  const double bandwidth =
      options_.bandwidth_hz.value_or(DefaultBandwidth(training_->time_bases()));
  rows_.identification = options_.identification;
  rows_.window_s = options_.window_s.value_or(
      bandwidth > 0 ? std::max(0.3, 1.5 / bandwidth) : 0.5);
  rows_.hops = kWindowHops;
  rows_.intervals = options_.intervals;
  rows_.interval_s = options_.interval_s;
  rows_.quadrature = options_.quadrature;
  rows_.bandwidth_hz = bandwidth;
  const double reach = RowReach(rows_);
  training_->Prepare(bandwidth, reach);
  if (validation_ != nullptr) validation_->Prepare(bandwidth, reach);
}

ModelParameters Calibrator::MakeParameters(
    const std::vector<std::vector<CoulombTransition>>& transitions) const {
  ModelParameters::Options options;
  options.geometry = options_.geometry;
  options.joint_terms = options_.joint_terms;
  options.transitions = transitions;
  return ModelParameters(robot_, options);
}

MatrixXd Calibrator::Reference(const ModelParameters& parameters,
                               const LogFactors& factors) const {
  // As fast as the joint that moves fastest, at half the bandwidth a tenth of
  // which is where motion lies (DefaultBandwidth).
  double speed = std::sqrt(factors.mean_square_speed().maxCoeff());
  if (speed < 1e-3) speed = 1;
  double motion_hz = 0.1;
  for (const TimeBase& base : training_->time_bases()) {
    motion_hz = std::max(motion_hz, base.motion_hz);
  }
  const bool integral = options_.identification == Identification::kIntegral;
  double unit = 1;
  if (integral) {
    unit = options_.interval_s;
    for (const TimeRange& r : options_.intervals) unit = r.end - r.begin;
  }
  return unit * ReferenceColumns(parameters, speed, motion_hz);
}

std::vector<std::vector<CoulombTransition>> Calibrator::FindTransitions() {
  const int n = robot_.num_joints();
  if (!has_coulomb()) return {};
  if (options_.transition) return {size_t(n), {*options_.transition}};
  const auto candidates = CandidateTransitions();
  const ModelParameters parameters = MakeParameters({size_t(n), candidates});
  const LogFactors factors(parameters, rows_, options_.progress, training_);
  ++passes_;
  const BlockTriangularFactor merged =
      factors.Merged(parameters, FindNonzero(factors));
  const std::vector<int> choice =
      ChooseTransitions(merged, parameters, RightSideRms(merged));
  std::vector<std::vector<CoulombTransition>> transitions;
  for (const int c : choice) transitions.push_back({candidates[c]});
  return transitions;
}

void Calibrator::CheckIntervals() const {
  if (options_.identification != Identification::kIntegral ||
      options_.intervals.empty()) {
    return;
  }
  const long expected =
      static_cast<long>(options_.intervals.size()) * training_->size();
  if (result_->equations < expected) {
    throw InputError(training_->path(0), "--intervals",
                     std::to_string(result_->equations) + " of " +
                         std::to_string(expected) + " intervals",
                     "expected every interval to lie within the log, clear of "
                     "gaps and standstill");
  }
}

// Equations without drive torque are left out where the joint has others; a
// joint that is never powered keeps them, for SolveFromFactors to weigh.
void Calibrator::FindUnpowered(const LogFactors& factors) {
  const int n = robot_.num_joints();
  const ModelParameters& parameters = result_->parameters;
  powered_ = FindNonzero(factors);
  for (int round = 0; round < 2; ++round) {
    const BlockTriangularFactor merged = factors.Merged(parameters, powered_);
    VectorXd noise = RightSideRms(merged);
    const LinearSolution solution = SolveReweighted(
        merged, reference_, std::vector<bool>(n, false), &noise);
    powered_ = FindPowered(factors, solution.x);
  }
  frozen_.assign(n, true);
  for (int i = 0; i < n; ++i) {
    for (int log = 0; log < training_->size(); ++log) {
      if (powered_[log][i]) {
        frozen_[i] = false;
        continue;
      }
      result_->unpowered.push_back({log, i, RightSideRms(factors.log(log))[i]});
    }
    if (!frozen_[i]) continue;
    for (auto& joints : powered_) joints[i] = true;
  }
}

void Calibrator::Reduce() {
  const ModelParameters& parameters = result_->parameters;
  const LogFactors factors(parameters, rows_, options_.progress, training_);
  ++passes_;
  reference_ = Reference(parameters, factors);
  for (int log = 0; log < factors.size(); ++log) {
    result_->equations += factors.log(log).rows(0);
  }
  CheckIntervals();
  powered_ = FindNonzero(factors);
  frozen_.assign(robot_.num_joints(), false);
  if (options_.solver == LinearSolver::kWeighted) {
    FindUnpowered(factors);
  } else {
    for (auto& joints : powered_) joints.assign(joints.size(), true);
  }
  factor_ = factors.Merged(parameters, powered_);
}

void Calibrator::SolveFromFactors() {
  LinearCalibration& result = *result_;
  const BlockTriangularFactor& factor = *factor_;
  result.noise = RightSideRms(factor);
  if (options_.solver == LinearSolver::kWeighted) {
    for (int i = 0; i < robot_.num_joints(); ++i) {
      if (frozen_[i]) result.noise[i] = 0;
    }
    solution_ = SolveReweighted(factor, reference_, frozen_, &result.noise);
    // The scale of a homogeneous equation's noise must not follow the
    // parameters down to zero: it is taken where the other joints put them.
    const VectorXd estimate = EstimateNoise(factor, solution_.x);
    for (int i = 0; i < robot_.num_joints(); ++i) {
      if (frozen_[i]) result.noise[i] = estimate[i];
    }
    solution_ = SolveReweighted(factor, reference_, frozen_, &result.noise);
  } else {
    solution_ = SolveBatch(factor, reference_);
    result.noise = EstimateNoise(factor, solution_.x);
  }
  result.identifiability = AnalyzeIdentifiability(factor, result.parameters,
                                                  result.noise, reference_);
  if (options_.solver == LinearSolver::kRecursive) {
    solution_ = SolveRecursive(factor, result.identifiability);
    if (solution_.solved) result.noise = EstimateNoise(factor, solution_.x);
  }
  result.solved = solution_.solved;
  result.reason = solution_.refusal;
  result.x = solution_.x;
  result.identifiable = solution_.identifiable;
}

template <class Visit>
void Calibrator::ForEachResidual(const std::string& stage, const Visit& visit) {
  const LinearCalibration& result = *result_;
  const int n = robot_.num_joints();
  std::vector<MotionRegressor> regressors(training_->size(),
                                          MotionRegressor(result.parameters));
  training_->ForEach(
      stage, options_.progress, [&](int log, const Trajectory& t) {
        ForEachRow(t, rows_, &regressors[log],
                   [&](const IdentificationRow& row) {
                     VectorXd r =
                         (row.Y - row.U * result.x).cwiseQuotient(result.noise);
                     for (int i = 0; i < n; ++i) {
                       if (!powered_[log][i]) r[i] = 0;
                     }
                     visit(log, t.segment, row, r);
                   });
      });
  ++passes_;
}

// Iteratively reweighted least squares: each pass weighs the rows by the last
// solution and sets the noise to the robust spread of its residuals.
void Calibrator::ReweightRows() {
  LinearCalibration& result = *result_;
  const int n = robot_.num_joints();
  for (int pass = 0; pass < kReweightingPasses; ++pass) {
    BlockTriangularFactor factor(result.parameters);
    std::vector<ResidualStatistics> statistics(n);
    ForEachResidual("robust weights", [&](int log, int,
                                          const IdentificationRow& row,
                                          const VectorXd& r) {
      for (int i = 0; i < n; ++i) {
        if (!powered_[log][i]) continue;
        statistics[i].Add(r[i]);
        factor.Add(i, row.U.row(i), row.Y[i], std::sqrt(Huber::Weight(r[i])));
      }
    });
    result.outliers.clear();
    for (int i = 0; i < n; ++i) {
      result.outliers.push_back(statistics[i].outliers());
      if (frozen_[i]) continue;
      const double spread = statistics[i].RobustSpread();
      if (spread > 1e-9) result.noise[i] *= spread;
    }
    solution_ = SolveWeighted(factor, result.noise, reference_);
    result.x = solution_.x;
  }
}

// Sums of scores per log differ more than their own autocorrelation tells when
// something changes from log to log (temperature, wear, a torque scale): with
// three logs or more, deviations are at least what that shows.
void Calibrator::InflateByLogs(const MatrixXd& sums) {
  const Eigen::Index logs = sums.cols();
  if (logs < 3) return;
  const double correction = static_cast<double>(logs) / (logs - 1.0);
  const MatrixXd between = solution_.gain * sums;
  VectorXd factor(sums.rows());
  for (Eigen::Index k = 0; k < factor.size(); ++k) {
    const double variance = correction * between.row(k).squaredNorm();
    const double within = result_->covariance(k, k);
    factor[k] = within > 0 ? std::sqrt(std::max(1.0, variance / within)) : 1;
  }
  result_->covariance =
      factor.asDiagonal() * result_->covariance * factor.asDiagonal();
  result_->covariance_method += ", at least the scatter between logs";
}

// Lag-one autocorrelation of the worst joint's residuals.
double Calibrator::Autocorrelation() {
  const int n = robot_.num_joints();
  std::vector<ResidualStatistics> statistics(n);
  int last_log = -1, last_segment = -1;
  ForEachResidual(
      "autocorrelation",
      [&](int log, int segment, const IdentificationRow&, const VectorXd& r) {
        const bool follows = log == last_log && segment == last_segment;
        last_log = log, last_segment = segment;
        for (int i = 0; i < n; ++i) {
          if (!powered_[log][i]) continue;
          if (!follows) statistics[i].Break();
          statistics[i].Add(r[i]);
        }
      });
  double rho = 0;
  for (const ResidualStatistics& s : statistics) {
    rho = std::max(rho, s.Autocorrelation());
  }
  return rho;
}

VectorXd Calibrator::Score(const IdentificationRow& row,
                           const VectorXd& r) const {
  VectorXd score = VectorXd::Zero(row.U.cols());
  for (int i = 0; i < r.size(); ++i) {
    const double scale = solution_.weight[i] * result_->noise[i] * r[i] *
                         (robust() ? Huber::Weight(r[i]) : 1);
    if (solution_.own_block_only) {
      const int begin = result_->parameters.block_begin(i);
      const int size = result_->parameters.block_size(i);
      score.segment(begin, size) +=
          scale * row.U.row(i).segment(begin, size).transpose();
    } else {
      score += scale * row.U.row(i).transpose();
    }
  }
  return score;
}

// The sandwich: gain times the long-run covariance of the scores times gain'.
void Calibrator::AccumulateScores(int window) {
  LinearCalibration& result = *result_;
  const int n = robot_.num_joints(), m = result.parameters.size();
  ScoreCovariance scores(m, window);
  MatrixXd sums = MatrixXd::Zero(m, training_->size());
  BlockTriangularFactor inside(result.parameters);
  int last_log = 0, last_segment = 0;
  ForEachResidual("covariance",
                  [&](int log, int segment, const IdentificationRow& row,
                      const VectorXd& r) {
                    if (log != last_log || segment != last_segment)
                      scores.Break();
                    last_log = log, last_segment = segment;
                    const VectorXd score = Score(row, r);
                    scores.Add(score);
                    sums.col(log) += score;
                    for (int i = 0; robust() && i < n; ++i) {
                      if (!powered_[log][i] || !Huber::Inside(r[i])) continue;
                      inside.Add(i, row.U.row(i), row.Y[i]);
                    }
                  });
  if (robust()) {  // Huber's loss is flat in the second derivative outside
    solution_.gain = SolveWeighted(inside, result.noise, reference_).gain;
  }
  result.covariance = solution_.CovarianceFromScores(scores.Value());
  result.covariance_method =
      "Newey-West over " + std::to_string(window) + " rows";
  InflateByLogs(sums);
}

void Calibrator::EstimateCovariance() {
  LinearCalibration& result = *result_;
  const int m = result.parameters.size();
  if (result.equations < 2 * m) {
    result.covariance = solution_.IndependentCovariance(*factor_, result.noise);
    result.covariance_method = "independent errors (few equations)";
  } else {
    const int least = kWindowHops + kWindowHops / 2;
    AccumulateScores(
        BartlettWindow(Autocorrelation(), result.equations, least));
  }
  result.stddev.setConstant(m, std::numeric_limits<double>::infinity());
  for (int k = 0; k < m; ++k) {
    if (result.identifiable[k]) {
      result.stddev[k] = std::sqrt(result.covariance(k, k));
    }
  }
}

void Calibrator::RecoverGeometry() {
  result_->lengths = RecoverLengths(result_->parameters, result_->x,
                                    result_->covariance, result_->identifiable);
}

TorqueResidual Calibrator::Evaluate(const std::string& stage, LogSet* logs) {
  TorqueResidual residual(robot_.num_joints());
  std::vector<MotionRegressor> regressors(logs->size(),
                                          MotionRegressor(result_->parameters));
  logs->ForEach(stage, options_.progress, [&](int log, const Trajectory& t) {
    regressors[log].Enter(t);
    residual.Add(t, result_->x, result_->bandwidth_hz, &regressors[log]);
  });
  return residual;
}

void Calibrator::EvaluateResiduals() {
  if (!result_->solved) return;
  result_->training = Evaluate("residuals", training_);
  ++passes_;
  if (validation_ != nullptr) {
    result_->validation = Evaluate("validation", validation_);
  }
}

}  // namespace

LinearCalibration CalibrateLinear(const Robot& robot,
                                  const LinearCalibrationOptions& options,
                                  LogSet* training, LogSet* validation) {
  return Calibrator(robot, options, training, validation).Run();
}

}  // namespace armcal
