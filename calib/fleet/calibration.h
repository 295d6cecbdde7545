#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/fleet/model.h"
#include "calib/fleet/reduction.h"
#include "calib/linear/calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// Fewer units do not tell their spread.
constexpr int kLeastUnits = 5;

// What units of one robot type share and how they differ, of their reduced
// logs. Rows are units, columns model parameters.
struct FleetCalibration {
  std::vector<std::string> units;  // their names, in order
  std::vector<int> logs;           // how many each has
  std::vector<long> equations;     // per joint
  // Each unit from its own logs alone; infinite where these do not tell.
  Eigen::MatrixXd own, own_stddev;
  Eigen::MatrixXd noise;  // units x joints, of the equations: N m, N
  FleetFit fit;
};

// The names of the units that logs are of; none is "".
std::vector<std::string> UnitNames(const Reduction& reduction);

// `pooled`: what CalibrateFromFactors made of all logs; its choice of equations
// is used. A joint's noise is each unit's own, as far as its data tell, else
// the median of all units.
FleetCalibration CalibrateFleet(const Robot& robot, const Reduction& reduction,
                                const LinearCalibration& pooled,
                                const FleetOptions& options,
                                const Progress& progress);

}  // namespace armcal
