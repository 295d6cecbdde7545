#pragma once

#include "calib/linear/solution.h"
#include "model/dynamics/model_parameters.h"
#include "model/signals/trajectory.h"
#include "problems/identification_rows.h"

namespace armcal {

// A linear calibration of a log in memory, reading left out: rows, their
// factors, the solution weighted by noise and its covariance. The log is worked
// through in stretches, as TrajectoryReader would cut it.
struct InMemoryCalibration {
  InMemoryCalibration(const ModelParameters& parameters,
                      const RowOptions& options, const Trajectory& log);

  LinearSolution solution;
  Eigen::VectorXd noise;
  Eigen::MatrixXd covariance;
};

}  // namespace armcal
