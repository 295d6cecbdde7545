#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/logs/prepared_logs.h"
#include "calib/logs/residual_map.h"
#include "calib/numerics/power_spectrum.h"
#include "calib/numerics/series_envelope.h"
#include "model/dynamics/model_parameters.h"

namespace armcal {

// A model whose torques are drawn beside the recorded ones.
struct TracedModel {
  std::string label;
  ModelParameters parameters;
  Eigen::VectorXd x;
};

// Torques of one log, N m or N, that recorded, and predicted by models.
struct TorqueTrace {
  TorqueTrace(int log, int num_joints, int num_models, int most_bins, double dt,
              int spectrum_window = 512);

  // A sample: recorded, n entries, and every model's, n x models. `moves`: the
  // joints whose residual counts for `where`, all where it is empty.
  void Add(double t, const Eigen::VectorXd& recorded,
           const Eigen::MatrixXd& predicted, const Eigen::VectorXd& q,
           const Eigen::VectorXd& qd, const std::vector<bool>& moves);
  void Break();  // the next sample does not follow the last

  int log;
  // n signals each: recorded, of every model, recorded minus every model's.
  SeriesEnvelope torque;
  // Of recorded minus predicted torque, n signals per model; empty where the
  // log is shorter than a window.
  PowerSpectrum residual;
  std::vector<ResidualMap> where;  // per joint, over the last model's torque
};

// Bins of a log's trace with which a page stays below 10 MB, and the logs that
// it draws at most.
constexpr int kMostDrawnLogs = 30;
int MostTraceBins(int logs, int num_joints, int num_models);

// Of every log, in one pass; low-passed at four times the bandwidth. Standstill
// does not count for `where`.
std::vector<TorqueTrace> TraceTorques(const std::vector<TracedModel>& models,
                                      int most_bins, const Progress& progress,
                                      const PreparedLogs& logs);

}  // namespace armcal
