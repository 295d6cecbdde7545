#include "calib/torque_residual.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/low_pass.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd PredictTorques(const Trajectory& trajectory, const VectorXd& x,
                        MotionRegressor* regressor) {
  MatrixXd predicted(trajectory.size(), trajectory.num_joints()), U;
  for (int k = 0; k < trajectory.size(); ++k) {
    regressor->Differential(k, &U);
    predicted.row(k) = U * x;
  }
  return predicted;
}

TorqueResidual::TorqueResidual(int num_joints) {
  for (Sums* sums : {&moving_, &whole_}) {
    sums->torque = sums->residual = Eigen::ArrayXd::Zero(num_joints);
  }
}

void TorqueResidual::Add(const Trajectory& trajectory, const VectorXd& x,
                         double bandwidth_hz, MotionRegressor* regressor) {
  MatrixXd predicted = PredictTorques(trajectory, x, regressor);
  MatrixXd recorded = trajectory.tau_recorded;
  if (bandwidth_hz > 0) {
    predicted = ZeroPhaseLowPass(predicted, 1 / trajectory.dt, bandwidth_hz);
    recorded = ZeroPhaseLowPass(recorded, 1 / trajectory.dt, bandwidth_hz);
  }
  for (int k = trajectory.core_begin; k < trajectory.core_end; ++k) {
    const Eigen::ArrayXd tau = recorded.row(k).transpose();
    const Eigen::ArrayXd r = tau - predicted.row(k).transpose().array();
    for (Sums* sums : {&moving_, &whole_}) {
      if (sums == &moving_ && trajectory.standstill[k]) continue;
      sums->torque += tau.square();
      sums->residual += r.square();
      sums->count += 1;
    }
  }
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
                                      const Progress& progress, LogSet* logs) {
  TorqueResidual residual(parameters.num_joints());
  std::vector<MotionRegressor> regressors(logs->size(),
                                          MotionRegressor(parameters));
  logs->ForEach(stage, progress, [&](int log, const Trajectory& t) {
    regressors[log].Enter(t);
    residual.Add(t, x, bandwidth_hz, &regressors[log]);
  });
  return residual;
}

}  // namespace armcal
