#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/logs/prepared_logs.h"
#include "model/dynamics/inverse_dynamics.h"

namespace armcal {

using Vector6d = Eigen::Matrix<double, 6, 1>;

// What a force-torque sensor measured at an instant, in its own axes, and how
// the last link moved that carries it.
struct ForceTorqueSample {
  int log = 0;
  double t = 0;                        // s since the log's first row
  bool follows = false;                // the sample before it, without a gap
  RigidMotion motion;                  // of the last link's frame L
  Vector6d wrench = Vector6d::Zero();  // force, N; torque, N m
};
using ForceTorqueSamples = std::vector<ForceTorqueSample>;

// Those of all logs that have the sensor's columns (LogReaderOptions::
// want_wrench), thinned to `most` (ThinnedSamples). The robot is a chain.
std::vector<ForceTorqueSample> GatherForceTorque(const Robot& robot,
                                                 const Progress& progress,
                                                 const PreparedLogs& logs,
                                                 long most = 1 << 17);

}  // namespace armcal
