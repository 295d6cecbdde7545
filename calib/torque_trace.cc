#include "calib/torque_trace.h"

#include <glog/logging.h>

#include "calib/torque_residual.h"
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
        PredictTorques(t, models[m].x, &(*regressors)[m]);
  }
  return predicted;
}

}  // namespace

std::vector<TorqueTrace> TraceTorques(const std::vector<TracedModel>& models,
                                      int most_bins, const Progress& progress,
                                      LogSet* logs) {
  CHECK(!models.empty());
  const int n = models[0].parameters.num_joints();
  const int count = static_cast<int>(models.size());
  std::vector<TorqueTrace> traces;
  std::vector<MotionRegressor> regressors;
  int segment = -1;
  logs->ForEach("torques", progress, [&](int log, const Trajectory& t) {
    if (traces.empty() || traces.back().log != log) {
      traces.push_back(
          {log, {n * (1 + 2 * count), most_bins}, {n * count, t.dt}});
      regressors.clear();
      for (const TracedModel& m : models) regressors.emplace_back(m.parameters);
      segment = t.segment;
    }
    TorqueTrace& trace = traces.back();
    if (t.segment != segment) trace.torque.Break(), trace.residual.Break();
    segment = t.segment;
    const MatrixXd predicted = Predict(models, t, &regressors);
    VectorXd all(n * (1 + 2 * count));
    for (int k = t.core_begin; k < t.core_end; ++k) {
      const VectorXd tau = t.tau_recorded.row(k).transpose();
      const VectorXd model = predicted.row(k).transpose();
      const VectorXd residual = tau.replicate(count, 1) - model;
      all << tau, model, residual;
      trace.torque.Add(t.time(k), all);
      trace.residual.Add(residual);
    }
  });
  return traces;
}

}  // namespace armcal
