#include "calib/compare/held_out_residuals.h"

#include <cmath>

#include "calib/logs/prepared_logs.h"
#include "calib/logs/torque_residual.h"
#include "calib/numerics/block_bootstrap.h"
#include "model/dynamics/model_parameters.h"
#include "model/signals/bandwidth.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Squares of residuals in cells of time (rows) and joints, and of torques.
struct CellSquares {
  std::vector<VectorXd> residual, torque;  // sums over a cell

  VectorXd Sum(const std::vector<VectorXd>& cells) const {
    VectorXd sum = VectorXd::Zero(cells.at(0).size());
    for (const VectorXd& cell : cells) sum += cell;
    return sum;
  }
};

ModelParameters ParametersOf(const PredictingRobot& predicting) {
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  for (const CoulombTransition& transition : predicting.transitions) {
    options.transitions.push_back({transition});
  }
  return ModelParameters(predicting.robot, options);
}

CellSquares SquaresOf(const PredictingRobot& predicting, double bandwidth_hz,
                      const Progress& progress, const PreparedLogs& logs) {
  constexpr double kCellSeconds = .1;
  const ModelParameters parameters = ParametersOf(predicting);
  const VectorXd x = parameters.Values(predicting.robot);
  std::vector<MotionRegressor> regressors(logs.size(),
                                          MotionRegressor(parameters));
  CellSquares squares;
  logs.ForEach("residuals", progress, [&](int log, const Trajectory& t) {
    regressors[log].Enter(t);
    const FilteredTorques torques =
        FilterTorques(t, x, bandwidth_hz, regressors[log]);
    const MatrixXd residual = torques.recorded - torques.predicted;
    const auto rows = static_cast<Eigen::Index>(
        std::max(1.0, std::round(kCellSeconds / t.dt)));
    for (Eigen::Index k = 0; k < residual.rows(); k += rows) {
      const Eigen::Index count = std::min(rows, residual.rows() - k);
      squares.residual.push_back(
          residual.middleRows(k, count).colwise().squaredNorm().transpose());
      squares.torque.push_back(torques.recorded.middleRows(k, count)
                                   .colwise()
                                   .squaredNorm()
                                   .transpose());
    }
  });
  return squares;
}

// Each cell's residual, relative to the log's torques, summed over joints.
std::vector<double> RelativeCells(const CellSquares& squares) {
  const VectorXd torque = squares.Sum(squares.torque);
  std::vector<double> cells;
  for (const VectorXd& cell : squares.residual) {
    double sum = 0;
    for (Eigen::Index j = 0; j < cell.size(); ++j) {
      if (torque[j] > 0) sum += cell[j] / torque[j];
    }
    cells.push_back(sum);
  }
  return cells;
}

ResidualRatio Ratio(int a, int b, const std::vector<double>& of_a,
                    const std::vector<double>& of_b) {
  const auto ratio = [&](const std::vector<int>& drawn) {
    double sum_a = 0, sum_b = 0;
    for (const int k : drawn) sum_a += of_a[k], sum_b += of_b[k];
    return std::sqrt(sum_b / sum_a);
  };
  const int size = static_cast<int>(of_a.size());
  std::vector<int> all(size);
  std::vector<double> logs(size);
  for (int k = 0; k < size; ++k) {
    all[k] = k;
    logs[k] = of_b[k] - of_a[k];
  }
  const int block = BootstrapBlock(size, CorrelationTime(logs));
  const BootstrapInterval interval = BlockBootstrap(size, block, 1, ratio);
  return {a, b, ratio(all), interval.low, interval.high};
}

}  // namespace

HeldOutResiduals CompareOnLogs(const std::vector<PredictingRobot>& robots,
                               std::optional<double> bandwidth_hz,
                               const Progress& progress, const LogSet& logs) {
  HeldOutResiduals result;
  result.bandwidth_hz =
      bandwidth_hz.value_or(DefaultBandwidth(logs.time_bases()));
  PreparationOptions preparation;
  preparation.bandwidth_hz = result.bandwidth_hz;
  const PreparedLogs prepared = Prepare(logs, preparation);
  std::vector<std::vector<double>> cells;
  for (const PredictingRobot& robot : robots) {
    const CellSquares squares =
        SquaresOf(robot, result.bandwidth_hz, progress, prepared);
    const VectorXd left = squares.Sum(squares.residual);
    const VectorXd torque = squares.Sum(squares.torque);
    result.robots.push_back({robot.name,
                             100 * left.cwiseQuotient(torque).cwiseSqrt(),
                             100 * std::sqrt(left.sum() / torque.sum())});
    cells.push_back(RelativeCells(squares));
  }
  for (size_t a = 0; a < robots.size(); ++a) {
    for (size_t b = a + 1; b < robots.size(); ++b) {
      result.ratios.push_back(
          Ratio(static_cast<int>(a), static_cast<int>(b), cells[a], cells[b]));
    }
  }
  return result;
}

}  // namespace armcal
