#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "calib/force_torque/fit.h"
#include "calib/force_torque/samples.h"
#include "calib/logs/prepared_logs.h"
#include "model/robot/robot.h"

namespace armcal {

// What a force-torque sensor on the last link carries, and the sensor's own
// bias and mounting, as logs with its six columns tell them.
struct ForceTorqueSensor {
  long samples = 0;  // 0: no log has the columns
  // Independent directions in which the force on the load was seen to change.
  int directions = 0;
  // Whether mass, centre, rotation and bias are told: `fit` then holds them.
  bool solved = false;
  ForceTorqueFit fit;
  // Entries of the inertia (Ixx, Ixy, Iyy, Ixz, Iyz, Izz) of which the samples
  // tell more than the prior does.
  std::array<bool, 6> inertia_told{};
  // What the logs cannot tell, a sentence each.
  std::vector<std::string> not_told;

  double Stddev(int unknown) const {
    return std::sqrt(fit.covariance(unknown, unknown));
  }
};

// Whether a sensor on the last link is one of a chain of known lengths.
bool CarriesForceTorque(const Robot& robot);

// The geometry is the robot's, a chain. A fit starts at what forces alone tell
// (StartForceTorque), with the rotation nearest to it (Procrustes), once for a
// sensor that reports the force on its load and once for one that reports the
// force of it; the likelier one is taken.
ForceTorqueSensor EstimateForceTorqueSensor(
    const std::vector<ForceTorqueSample>& samples);

// The same of prepared logs. Nothing where no log has the columns, where the
// robot branches, or where some of its lengths are unknown.
ForceTorqueSensor EstimateForceTorqueSensor(const Robot& robot,
                                            const Progress& progress,
                                            const PreparedLogs& logs);

}  // namespace armcal
