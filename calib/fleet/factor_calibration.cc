#include "calib/fleet/factor_calibration.h"

#include <algorithm>
#include <cmath>

#include "calib/linear/calibration_checks.h"
#include "calib/linear/calibration_model.h"
#include "calib/linear/factor_solution.h"
#include "calib/linear/row_covariance.h"
#include "calib/linear/used_equations.h"
#include "model/text/input_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What of a log's equations is used.
BlockTriangularFactor Used(const LogFactors& factors,
                           const ModelParameters& parameters,
                           const EquationMask& used, int log) {
  BlockTriangularFactor factor(parameters);
  for (int i = 0; i < parameters.num_joints(); ++i) {
    if (used[log][i]) factor.Merge(factors.log(log), i);
  }
  return factor;
}

// Sum over joints of weight_i R_i' (z_i - R_i x).
VectorXd ScoreSum(const BlockTriangularFactor& factor,
                  const LinearSolution& solution) {
  VectorXd sum = VectorXd::Zero(factor.num_parameters());
  for (int i = 0; i < factor.num_joints(); ++i) {
    const std::vector<int>& columns = factor.columns(i);
    const auto k = static_cast<Eigen::Index>(columns.size());
    const MatrixXd& R = factor.Triangle(i);
    const VectorXd residual = R.col(k) - R.leftCols(k) * solution.x(columns);
    sum(columns) += solution.weight[i] * R.leftCols(k).transpose() * residual;
  }
  return sum;
}

void SetCovariance(const LogFactors& factors, const VectorXd& inflations,
                   const LinearSolution& solution, LinearCalibration* result) {
  const int m = result->parameters.size();
  MatrixXd independent = MatrixXd::Zero(m, m), correlated = independent;
  MatrixXd sums(m, factors.size());
  for (int log = 0; log < factors.size(); ++log) {
    const BlockTriangularFactor factor =
        Used(factors, result->parameters, result->used, log);
    const MatrixXd own = solution.IndependentCovariance(factor, result->noise);
    independent += own;
    correlated += std::pow(inflations[log], 2) * own;
    sums.col(log) = ScoreSum(factor, solution);
  }
  result->independent_covariance = independent;
  result->covariance = RaiseToLogScatter(correlated, solution.gain, sums);
  result->covariance_method = "independent rows, inflated as each log's own";
  if (factors.size() >= 3) {
    result->covariance_method += ", at least the scatter between logs";
  }
  result->inflation = MedianInflation(result->covariance, independent);
  AddScaleCovariance(solution, result);
}

}  // namespace

ModelParameters ParametersOf(const Robot& robot, const ReductionModel& model,
                             const std::string& file) {
  const LinearCalibrationOptions options = model.Options();
  const Transitions transitions =
      GivenTransitions(robot, options).value_or(Transitions());
  const bool fits = transitions.empty() ||
                    static_cast<int>(transitions.size()) == robot.num_joints();
  if (fits) {
    ModelParameters parameters = MakeParameters(robot, options, transitions);
    std::vector<std::string> names;
    for (const auto& p : parameters.parameters()) names.push_back(p.name);
    if (names == model.parameters) return parameters;
  }
  throw InputError(file, "key model.parameters", "",
                   "expected those of " + robot.name + ", with the same " +
                       OptionName("base") + ", " + OptionName("tip") + " and " +
                       OptionName("gravity"));
}

BlockTriangularFactor FactorOf(const ModelParameters& parameters,
                               const ReducedLog& log) {
  return {parameters, log.factors};
}

LogFactors FactorsOf(const ModelParameters& parameters,
                     const Reduction& reduction) {
  const int n = parameters.num_joints();
  std::vector<BlockTriangularFactor> factors;
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(n);
  VectorXd travel = VectorXd::Zero(n);
  double samples = 0;
  for (const ReducedLog& log : reduction.logs) {
    factors.push_back(FactorOf(parameters, log));
    const auto count = static_cast<double>(log.samples);
    squares += count * log.mean_square_speed;
    samples += count;
    travel = travel.cwiseMax(log.travel);
  }
  return {std::move(factors), squares / std::max(1., samples), travel};
}

VectorXd Inflations(const Reduction& reduction) {
  std::vector<double> known;
  for (const ReducedLog& log : reduction.logs) {
    if (log.inflation) known.push_back(*log.inflation);
  }
  const RowOptions& rows = reduction.model.rows;
  double median =
      rows.identification == Identification::kWeak ? std::sqrt(rows.hops) : 1;
  if (!known.empty()) {
    std::nth_element(known.begin(), known.begin() + known.size() / 2,
                     known.end());
    median = known[known.size() / 2];
  }
  VectorXd inflations(reduction.logs.size());
  for (size_t k = 0; k < reduction.logs.size(); ++k) {
    inflations[k] = reduction.logs[k].inflation.value_or(median);
  }
  return inflations;
}

LinearCalibration CalibrateFromFactors(const Robot& robot,
                                       const Reduction& reduction) {
  const ReductionModel& model = reduction.model;
  LinearCalibration result(ParametersOf(robot, model));
  result.transitions = model.transitions;
  result.rows = model.rows;
  result.loss = model.loss;
  result.joint_terms = model.joint_terms;
  const LogFactors factors = FactorsOf(result.parameters, reduction);
  result.travel = factors.travel();
  result.mean_square_speed = factors.mean_square_speed();
  double motion_hz = 0;
  for (const ReducedLog& log : reduction.logs) {
    result.equations += log.factors[0].rows();
    motion_hz = std::max(motion_hz, log.motion_hz);
    result.torque_constants_stddev =
        std::max(result.torque_constants_stddev, log.torque_constants_stddev);
  }
  result.reason = WhyNothingToSolve(factors, result.parameters);
  if (!result.reason.empty()) return result;
  const ReferenceScale reference =
      MakeReference(result.parameters, model.rows, motion_hz, factors);
  const UsedEquations equations =
      FindUsedEquations(factors, result.parameters, reference);
  result.used = equations.used;
  result.unpowered = equations.unpowered;
  const LinearSolution solution =
      SolveFactor(factors.Merged(result.parameters, result.used), reference,
                  equations.frozen, LinearSolver::kWeighted, &result);
  result.x = solution.x;
  result.identifiable = solution.identifiable;
  if (!result.solved) return result;
  SetCovariance(factors, Inflations(reduction), solution, &result);
  result.lengths =
      RecoverLengths(result.parameters, result.x, result.independent_covariance,
                     result.covariance, result.identifiable);
  return result;
}

}  // namespace armcal
