#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/logs/channel_audit.h"
#include "calib/logs/inspection_finding.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

// In which units a log has positions.
struct PositionUnits {
  bool degrees = false;      // of joints that turn, not rad
  bool millimetres = false;  // of joints that slide, not m

  int column = -1;  // of this column alone; -1: of all

  // Of this joint, whose positions are in column `from`; rad or m.
  double Of(const Joint& joint, int from) const;
  bool any() const { return degrees || millimetres; }
};

// What speaks for a unit, but for torques.
struct PositionUnitHint {
  std::string evidence;  // empty: nothing
  // Positions are where the joints cannot be as logged, and can in that unit.
  bool out_of_reach = false;
  // Recorded velocities say so by themselves.
  bool by_velocities = false;
};

struct PositionUnitHints {
  PositionUnitHint degrees, millimetres;
};

// Recorded velocities that are the slopes of positions in that unit, of all
// joints of the kind that move, and are not as logged; or
// positions, or their slopes (`qd`, samples x n, as logged), that are closer to
// the robot file's limits in that unit: a hundredth of them is beyond these by
// more than the root of the units' ratio. Single glitches go anywhere.
PositionUnitHints HintsOfPositionUnit(const Robot& robot, const Log& log,
                                      const Eigen::MatrixXd& qd);

// Of a log whose positions are in these units: puts that before all other
// findings and takes out those that follow from it, velocities that are not the
// slopes of positions as logged. Returns which joints' velocities these are.
std::vector<bool> PutPositionUnitFirst(
    const Robot& robot, const Log& log, const PositionUnits& units,
    std::vector<InspectionFinding>* findings);

}  // namespace armcal
