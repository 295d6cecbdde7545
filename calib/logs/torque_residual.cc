#include "calib/logs/torque_residual.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/signals/low_pass.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd PredictTorques(const Trajectory& trajectory, const VectorXd& x,
                        const MotionRegressor& regressor) {
  constexpr int kBatch = 256;
  const auto& used = regressor.row_columns();
  MatrixXd predicted(trajectory.size(), trajectory.num_joints());
  JointColumns U;
  U.Resize(RowSizes(regressor, 0), kBatch);
  for (int first = 0; first < trajectory.size(); first += kBatch) {
    const int count = std::min(kBatch, trajectory.size() - first);
    regressor.Differential(first, count, U.data(), U.stride());
    for (int i = 0; i < trajectory.num_joints(); ++i) {
      predicted.col(i).segment(first, count) =
          Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>>(
              U.column(i, 0), count, static_cast<int>(used[i].size()),
              Eigen::OuterStride<>(U.stride())) *
          x(used[i]);
    }
  }
  return predicted;
}

namespace {

// `recorded`: of all samples of the trajectory.
FilteredTorques Filtered(const Trajectory& trajectory, double bandwidth_hz,
                         MatrixXd recorded, MatrixXd predicted) {
  if (bandwidth_hz > 0) {
    predicted = ZeroPhaseLowPass(predicted, 1 / trajectory.dt, bandwidth_hz);
    recorded = ZeroPhaseLowPass(recorded, 1 / trajectory.dt, bandwidth_hz);
  }
  const auto core = Eigen::seq(trajectory.core_begin, trajectory.core_end - 1);
  return {recorded(core, Eigen::all), predicted(core, Eigen::all)};
}

}  // namespace

FilteredTorques FilterTorques(const Trajectory& trajectory, const VectorXd& x,
                              double bandwidth_hz,
                              const MotionRegressor& regressor) {
  return Filtered(trajectory, bandwidth_hz, trajectory.tau_recorded,
                  PredictTorques(trajectory, x, regressor));
}

TorqueResidual::TorqueResidual(int num_joints) {
  for (Sums* sums : {&moving_, &whole_, &kept_}) {
    sums->torque = sums->residual = Eigen::ArrayXd::Zero(num_joints);
  }
}

void TorqueResidual::Add(const Trajectory& trajectory, const VectorXd& x,
                         double bandwidth_hz,
                         const MotionRegressor& regressor) {
  const MatrixXd predicted = PredictTorques(trajectory, x, regressor);
  const FilteredTorques recorded =
      Filtered(trajectory, bandwidth_hz, trajectory.tau_recorded, predicted);
  const FilteredTorques kept =
      trajectory.tau == trajectory.tau_recorded
          ? recorded
          : Filtered(trajectory, bandwidth_hz, trajectory.tau, predicted);
  for (int k = trajectory.core_begin; k < trajectory.core_end; ++k) {
    const int row = k - trajectory.core_begin;
    whole_.Add(recorded, row);
    if (trajectory.standstill[k]) continue;
    moving_.Add(recorded, row);
    kept_.Add(kept, row);
  }
}

void TorqueResidual::Sums::Add(const FilteredTorques& torques, int row) {
  const Eigen::ArrayXd tau = torques.recorded.row(row).transpose();
  torque += tau.square();
  residual += (tau - torques.predicted.row(row).transpose().array()).square();
  count += 1;
}

double TorqueResidual::excluded_share() const {
  return whole_.count > 0 ? 1 - moving_.count / whole_.count : 0;
}

TorqueResidual::Figures TorqueResidual::MakeFigures(const Sums& sums) {
  const double count = std::max(1.0, sums.count);
  Figures f;
  f.torque_rms = (sums.torque / count).sqrt();
  f.residual_rms = (sums.residual / count).sqrt();
  f.percent = 100 * (sums.residual / sums.torque).sqrt();
  for (int j = 0; j < f.percent.size(); ++j) {
    if (sums.torque[j] <= 0) f.percent[j] = std::nan("");
  }
  const double torque = sums.torque.sum();
  f.stacked_percent =
      torque > 0 ? 100 * std::sqrt(sums.residual.sum() / torque) : std::nan("");
  return f;
}

TorqueResidual EvaluateTorqueResidual(const ModelParameters& parameters,
                                      const VectorXd& x, double bandwidth_hz,
                                      const std::string& stage,
                                      const Progress& progress,
                                      const PreparedLogs& logs) {
  TorqueResidual residual(parameters.num_joints());
  std::vector<MotionRegressor> regressors(logs.size(),
                                          MotionRegressor(parameters));
  logs.ForEach(stage, progress, [&](int log, const Trajectory& t) {
    regressors[log].Enter(t);
    residual.Add(t, x, bandwidth_hz, regressors[log]);
  });
  return residual;
}

}  // namespace armcal
