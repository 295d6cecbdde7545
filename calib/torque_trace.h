#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/log_set.h"
#include "calib/power_spectrum.h"
#include "calib/series_envelope.h"
#include "model/model_parameters.h"

namespace armcal {

// A model whose torques are drawn beside the recorded ones.
struct TracedModel {
  std::string label;
  ModelParameters parameters;
  Eigen::VectorXd x;
};

// Torques of one log, N m or N, low-passed at four times the bandwidth.
struct TorqueTrace {
  int log = 0;
  // n signals each: recorded, of every model, recorded minus every model's.
  SeriesEnvelope torque;
  // Of recorded minus predicted torque, n signals per model; empty where the
  // log is shorter than a window.
  PowerSpectrum residual;
};

// Of every log, in one pass.
std::vector<TorqueTrace> TraceTorques(const std::vector<TracedModel>& models,
                                      int most_bins, const Progress& progress,
                                      LogSet* logs);

}  // namespace armcal
