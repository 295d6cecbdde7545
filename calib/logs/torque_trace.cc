#include "calib/logs/torque_trace.h"

#include <glog/logging.h>

#include <algorithm>

#include "calib/logs/torque_residual.h"
#include "problems/identification_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The models' torques of a trajectory, side by side.
MatrixXd Predict(const std::vector<TracedModel>& models, const Trajectory& t,
                 std::vector<MotionRegressor>* regressors) {
  const int n = t.num_joints();
  MatrixXd predicted(t.size(), n * static_cast<int>(models.size()));
  for (size_t m = 0; m < models.size(); ++m) {
    (*regressors)[m].Enter(t);
    predicted.middleCols(static_cast<int>(m) * n, n) =
        PredictTorques(t, models[m].x, (*regressors)[m]);
  }
  return predicted;
}

}  // namespace

TorqueTrace::TorqueTrace(int log, int num_joints, int num_models, int most_bins,
                         double dt, int spectrum_window)
    : log(log),
      torque(num_joints * (1 + 2 * num_models), most_bins),
      residual(num_joints * num_models, dt, spectrum_window),
      where(num_joints, ResidualMap(num_models)) {}

void TorqueTrace::Add(double t, const VectorXd& recorded,
                      const MatrixXd& predicted, const VectorXd& q,
                      const VectorXd& qd, const std::vector<bool>& moves) {
  const MatrixXd left = recorded.replicate(1, predicted.cols()) - predicted;
  VectorXd all(torque.num_signals());
  all << recorded, predicted.reshaped(), left.reshaped();
  torque.Add(t, all);
  residual.Add(left.reshaped());
  for (int j = 0; j < recorded.size(); ++j) {
    if (!moves.empty() && !moves[j]) continue;
    where[j].Add({q[j], qd[j], predicted(j, predicted.cols() - 1), t},
                 left.row(j));
  }
}

void TorqueTrace::Break() {
  torque.Break();
  residual.Break();
}

int MostTraceBins(int logs, int num_joints, int num_models) {
  constexpr int kNumbers = 600'000;  // of about 8 characters
  logs = std::min(logs, kMostDrawnLogs);
  const int per_bin = 2 * num_joints * (1 + 2 * num_models);
  return std::clamp(kNumbers / std::max(1, logs * per_bin), 20, 2000);
}

std::vector<TorqueTrace> TraceTorques(const std::vector<TracedModel>& models,
                                      int most_bins, const Progress& progress,
                                      const PreparedLogs& logs) {
  CHECK(!models.empty());
  const int n = models[0].parameters.num_joints();
  const int count = static_cast<int>(models.size());
  std::vector<TorqueTrace> traces;
  std::vector<MotionRegressor> regressors;
  int segment = -1;
  logs.ForEach("torques", progress, [&](int log, const Trajectory& t) {
    if (traces.empty() || traces.back().log != log) {
      traces.emplace_back(log, n, count, most_bins, t.dt);
      regressors.clear();
      for (const TracedModel& m : models) regressors.emplace_back(m.parameters);
      segment = t.segment;
    }
    TorqueTrace& trace = traces.back();
    if (t.segment != segment) trace.Break();
    segment = t.segment;
    const MatrixXd predicted = Predict(models, t, &regressors);
    for (int k = t.core_begin; k < t.core_end; ++k) {
      trace.Add(t.time(k), t.tau_recorded.row(k),
                predicted.row(k).reshaped(n, count), t.q.row(k), t.qd.row(k),
                std::vector<bool>(n, !t.standstill[k]));
    }
  });
  return traces;
}

}  // namespace armcal
