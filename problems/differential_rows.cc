#include "problems/differential_rows.h"

#include <algorithm>
#include <cmath>

#include "model/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

// Columns of one joint's equation at every sample, the torque last.
void FillColumns(const MatrixXd& U, const Eigen::MatrixXd& tau, int sample,
                 const ModelParameters& parameters,
                 std::vector<MatrixXd>* columns) {
  for (int i = 0; i < parameters.num_joints(); ++i) {
    const std::vector<int>& used = parameters.row_columns(i);
    MatrixXd& C = (*columns)[i];
    for (size_t c = 0; c < used.size(); ++c) C(sample, c) = U(i, used[c]);
    C(sample, used.size()) = tau(sample, i);
  }
}

}  // namespace

double DifferentialReach(const RowOptions& options) {
  return LowPassMemory(options.bandwidth_hz);
}

void ForEachDifferentialRow(const Trajectory& trajectory,
                            const RowOptions& options,
                            MotionRegressor* regressor, const RowSink& sink) {
  const ModelParameters& parameters = regressor->parameters();
  const int n = trajectory.num_joints();
  const int samples = trajectory.size();
  const double dt = trajectory.dt;
  const bool filter = options.bandwidth_hz > 0;
  std::vector<MatrixXd> columns(n);
  for (int i = 0; i < n; ++i) {
    columns[i].resize(samples, parameters.row_columns(i).size() + 1);
  }
  MatrixXd U;
  for (int k = 0; k < samples; ++k) {
    regressor->Differential(k, &U);
    FillColumns(U, trajectory.tau, k, parameters, &columns);
  }
  for (MatrixXd& C : columns) {
    if (filter) C = ZeroPhaseLowPass(C, 1 / dt, options.bandwidth_hz);
  }
  const long stride =
      filter
          ? std::max(1L, static_cast<long>(0.25 / (options.bandwidth_hz * dt)))
          : 1;
  // What lies beyond the ends of a log the filter has to invent.
  const int edge =
      filter ? static_cast<int>(std::ceil(1.5 / (options.bandwidth_hz * dt)))
             : 0;
  IdentificationRow row;
  row.U.setZero(n, parameters.size());
  row.Y.resize(n);
  for (int k = std::max(edge, trajectory.core_begin);
       k < std::min(samples - edge, trajectory.core_end); ++k) {
    if ((trajectory.first_index + k) % stride != 0 || regressor->Useless(k)) {
      continue;
    }
    for (int i = 0; i < n; ++i) {
      const std::vector<int>& used = parameters.row_columns(i);
      for (size_t c = 0; c < used.size(); ++c) {
        row.U(i, used[c]) = columns[i](k, c);
      }
      row.Y[i] = columns[i](k, used.size());
    }
    row.time = trajectory.time(k);
    sink(row);
  }
}

}  // namespace armcal
