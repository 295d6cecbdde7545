#pragma once

#include <vector>

#include "calib/diagnose/data/audit.h"
#include "calib/diagnose/data/segment.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// A joint that swung freely in a log: its drive did next to nothing beside
// gravity and inertia, which cancel there.
struct SwungJoint {
  int log = 0;            // as its segments have it
  int joint = 0;          // from 0
  double torque_rms = 0;  // recorded, N m or N
  double needed_rms = 0;  // of gravity's and inertia's by themselves, N m or N
};

// Joints of each log whose recorded torque is below a twentieth of what gravity
// and inertia of this robot ask by themselves (FindUsedEquations' share). The
// equation of motion of such a joint is homogeneous: it knows no scale, and is
// solved best by an arm without mass. Joints without any torque are not asked.
std::vector<SwungJoint> FindSwungJoints(
    const Robot& robot, const std::vector<GapSegment>& segments);

// Nothing is asked of these from now on, as if they had stood still, and a
// finding each: of a reference, which has to tell the scale. Where
// nothing else moves, all stays as it is: torques may as well be in another
// unit. `logs`: whose segments they are.
std::vector<DataFinding> LeaveOutSwungJoints(const Robot& robot,
                                             const LogSet& logs,
                                             std::vector<GapSegment>* segments);

}  // namespace armcal
