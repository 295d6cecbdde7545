#include "calib/torque_trace.h"

#include <glog/logging.h>

#include "problems/identification_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The models' torques of a trajectory, side by side.
MatrixXd Predict(const std::vector<TracedModel>& models, const Trajectory& t,
                 std::vector<MotionRegressor>* regressors) {
  const int n = t.num_joints();
  MatrixXd predicted(t.size(), n * static_cast<int>(models.size())), U;
  for (size_t m = 0; m < models.size(); ++m) {
    (*regressors)[m].Enter(t);
    for (int k = 0; k < t.size(); ++k) {
      (*regressors)[m].Differential(k, &U);
      predicted.row(k).segment(static_cast<int>(m) * n, n) = U * models[m].x;
    }
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
      traces.push_back({log, {n * (1 + 2 * count), most_bins}, {}});
      traces.back().residual.emplace(n * count, t.dt);
      regressors.clear();
      for (const TracedModel& m : models) regressors.emplace_back(m.parameters);
      segment = t.segment;
    }
    TorqueTrace& trace = traces.back();
    if (t.segment != segment) trace.torque.Break(), trace.residual->Break();
    segment = t.segment;
    const MatrixXd predicted = Predict(models, t, &regressors);
    VectorXd all(n * (1 + 2 * count));
    for (int k = t.core_begin; k < t.core_end; ++k) {
      const VectorXd tau = t.tau_recorded.row(k).transpose();
      const VectorXd model = predicted.row(k).transpose();
      const VectorXd residual = tau.replicate(count, 1) - model;
      all << tau, model, residual;
      trace.torque.Add(t.time(k), all);
      trace.residual->Add(residual);
    }
  });
  for (TorqueTrace& trace : traces) {
    if (trace.residual->empty()) trace.residual.reset();
  }
  return traces;
}

}  // namespace armcal
