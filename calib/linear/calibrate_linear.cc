#include "calib/linear/calibrate_linear.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calib/linear/calibration_checks.h"
#include "calib/linear/calibration_model.h"
#include "calib/linear/factor_solution.h"
#include "calib/linear/log_factors.h"
#include "calib/linear/robust_solution.h"
#include "calib/linear/torque_outliers.h"
#include "calib/linear/transition_search.h"
#include "calib/linear/used_equations.h"
#include "calib/linear/width_covariance.h"
#include "calib/logs/sample_pass.h"
#include "problems/make_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void SetCovariance(const CovarianceEstimate& estimate,
                   LinearCalibration* result) {
  result->covariance = estimate.covariance;
  result->covariance_method = estimate.method;
  result->score_window = estimate.window;
  result->rows_per_window = estimate.rows_per_window;
}

// Goes from the factor to the parameters and their covariance, in this order:
// the solution from the factor; robust weights, which need the rows and begin
// there; the covariance for independent errors, which lengths are weighed with;
// the one of errors that follow each other, which is reported; and what wrong
// torque constants add. With fewer equations than twice the parameters a
// residual is as much the fit's as the sample's, and robust weights would drop
// good rows.
void Estimate(const Robot& robot, const LinearCalibrationOptions& options,
              const RowOptions& rows, const BlockTriangularFactor& factor,
              const ReferenceScale& reference, const std::vector<bool>& frozen,
              ResidualPass* pass, LinearCalibration* result) {
  LinearSolution solution =
      SolveFactor(factor, reference, frozen, options.solver, result);
  result->x = solution.x;
  result->identifiable = solution.identifiable;
  if (!result->solved) return;
  // Too few to tell outliers from what the parameters do not fit; or, all
  // joints together, how errors follow each other.
  const int m = result->parameters.size();
  const bool few = result->equations < 2 * m;
  const bool scarce = result->equations * robot.num_joints() < 4 * m;
  if (options.solver == LinearSolver::kWeighted && !few) {
    result->loss = options.loss.value_or(RobustLoss::kHuber);
  }
  if (result->loss != RobustLoss::kSquared) {
    RobustSolution robust = SolveRobust(solution.x, result->noise, frozen,
                                        result->loss, reference, pass);
    solution = std::move(robust.solution);
    result->x = solution.x;
    result->identifiable = solution.identifiable;
    result->noise = robust.noise;
    result->outliers = robust.outliers;
  }
  result->independent_covariance =
      solution.IndependentCovariance(factor, result->noise);
  if (scarce) {
    SetCovariance(
        {result->independent_covariance, "independent errors (few equations)"},
        result);
  } else {
    SetCovariance(EstimateCovariance(robot, options, rows, solution,
                                     result->loss, reference, pass, *result),
                  result);
    result->inflation =
        MedianInflation(result->covariance, result->independent_covariance);
  }
  AddScaleCovariance(solution, result);
}

}  // namespace

LinearCalibration::LinearCalibration(const ModelParameters& model)
    : parameters(model),
      x(VectorXd::Zero(model.size())),
      stddev(VectorXd::Constant(model.size(),
                                std::numeric_limits<double>::infinity())),
      identifiable(model.size(), false),
      noise(VectorXd::Constant(model.num_joints(), std::nan(""))) {
  identifiability.total = model.size();
  identifiability.block_rank.assign(model.num_joints(), 0);
  for (int i = 0; i < model.num_joints(); ++i) {
    identifiability.block_size.push_back(model.block_size(i));
  }
}

namespace {

// Calibrates from the logs as the set now gives them.
LinearCalibration CalibrateOnce(const Robot& robot,
                                const LinearCalibrationOptions& options,
                                const RowOptions& rows,
                                const Transitions& transitions,
                                const PreparedLogs& training) {
  LinearCalibration result(MakeParameters(robot, options, transitions));
  for (const auto& t : transitions) result.transitions.push_back(t.front());
  result.fitted_transitions =
      !transitions.empty() && !GivenTransitions(robot, options);
  result.rows = rows;
  result.solver = options.solver;
  result.joint_terms = options.joint_terms;
  result.torque_constants_stddev = training.logs().torque_constants_stddev();

  const LogFactors factors(result.parameters, rows, options.progress, training);
  result.travel = factors.travel();
  result.mean_square_speed = factors.mean_square_speed();
  for (int log = 0; log < factors.size(); ++log) {
    result.equations += factors.log(log).rows(0);
  }
  CheckIntervals(rows, training.logs(), result.equations);
  result.reason = WhyNothingToSolve(factors, result.parameters);
  if (!result.reason.empty()) return result;
  double motion_hz = 0;
  for (const TimeBase& base : training.time_bases()) {
    motion_hz = std::max(motion_hz, base.motion_hz);
  }
  const ReferenceScale reference =
      MakeReference(result.parameters, rows, motion_hz, factors);
  UsedEquations equations = AllEquations(factors, robot.num_joints());
  if (options.solver == LinearSolver::kWeighted) {
    equations = FindUsedEquations(factors, result.parameters, reference);
    result.unpowered = equations.unpowered;
  }
  result.used = equations.used;
  ResidualPass pass(result.parameters, rows, equations.used, options.progress,
                    training);
  Estimate(robot, options, rows,
           factors.Merged(result.parameters, equations.used), reference,
           equations.frozen, &pass, &result);
  result.passes = pass.passes() + 1;  // the factors
  return result;
}

// Calibrates, takes out the torque samples that the calibration shows to be
// wrong, and again until these and the parameters stay the same; *training are
// then the logs without these. *samples has looked at the result's residuals
// last, or is empty. Rows' robust weights do not do this: a single wrong sample
// is spread over all windows and over the low pass's memory, where no row
// sticks out enough.
LinearCalibration CalibrateWithoutOutliers(
    const Robot& robot, const LinearCalibrationOptions& options,
    const RowOptions& rows, PreparedLogs* training,
    std::optional<SamplePass>* samples) {
  constexpr int kMostRounds = 4;
  constexpr double kSettled = 0.1;  // standard deviations
  LinearCalibration result = CalibrateOnce(
      robot, options, rows, FindTransitions(robot, options, rows, *training),
      *training);
  result.passes += result.fitted_transitions ? 2 : 0;
  const bool as_is = options.loss == RobustLoss::kSquared;
  if (as_is || rows.bandwidth_hz <= 0) return result;
  double moved = 0;
  for (int round = 0; round < kMostRounds && result.solved; ++round) {
    // Spikes that the first round replaced count as other samples.
    const bool as_recorded = round == 0 && training->spikes() == 0;
    const OutlierLists last =
        as_recorded ? OutlierLists(training->size())
                    : training->options().outliers.value_or(OutlierLists());
    samples->emplace(result.parameters, result.x, options.progress, *training);
    PreparationOptions without = training->options();
    without.outliers = FindTorqueOutliers(&**samples);
    *training = Prepare(training->logs(), without);
    const int passes = ++result.passes;
    const bool same = SameSamples(*without.outliers, last);
    if (same && (round == 0 || moved < kSettled)) break;
    samples->reset();
    const VectorXd from = result.x;
    result = CalibrateOnce(
        robot, options, rows,
        FollowTransitions(robot, options, rows, result.transitions, *training),
        *training);
    result.passes += passes + (result.fitted_transitions ? 1 : 0);
    moved =
        (result.x - from).cwiseQuotient(result.stddev).cwiseAbs().maxCoeff();
  }
  return result;
}

}  // namespace

// Everything that is reported of a calibration, once its parameters are found:
// lengths, residuals in the logs it was fitted to and in those held out, and
// the noise of samples.
LinearCalibration CalibrateLinear(const Robot& robot,
                                  const LinearCalibrationOptions& options,
                                  const LogSet& training,
                                  const LogSet* validation) {
  const RowOptions rows = MakeRowOptions(options, training);
  CheckBandwidth(options.bandwidth_hz, training);
  PreparedLogs prepared = Prepare(
      training, PreparationForRows(rows, options.loss != RobustLoss::kSquared));
  std::optional<SamplePass> samples;
  LinearCalibration result =
      CalibrateWithoutOutliers(robot, options, rows, &prepared, &samples);
  result.preparation = prepared.options();
  result.friction = prepared.friction();
  ++result.passes;  // the audit
  if (!result.solved) return result;

  result.lengths =
      RecoverLengths(result.parameters, result.x, result.independent_covariance,
                     result.covariance, result.identifiable);
  const auto evaluate = [&](const std::string& stage,
                            const PreparedLogs& logs) {
    return EvaluateTorqueResidual(result.parameters, result.x,
                                  rows.bandwidth_hz, stage, options.progress,
                                  logs);
  };
  result.training = evaluate("residuals", prepared);
  // The logs may have been prepared again, for the outliers found last, and are
  // not gone through before that.
  result.position_spikes = prepared.position_spikes();
  if (!samples) {
    samples.emplace(result.parameters, result.x, options.progress, prepared);
  }
  result.sample_noise = EstimateSampleNoise(
      result.preparation.outliers.value_or(OutlierLists()), &*samples);
  result.passes += 2;
  if (validation != nullptr) {
    result.validation =
        evaluate("validation", Prepare(*validation, PreparationForRows(rows)));
    CheckNoOverflow(*result.validation, *validation);
  }
  return result;
}

}  // namespace armcal
