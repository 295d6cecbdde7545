#pragma once

#include "model/log_files/pose_reader.h"
#include "model/robot/arm_geometry.h"
#include "problems/poses/pose_problem.h"

namespace armcal {

// A first guess of the instrument's frame (by Kabsch's alignment of tool
// positions) or of a wire's anchor (by linear trilateration), the arm's own
// geometry as in `geometry`, targets at the tool's origin.
PoseUnknowns StartPoses(const ArmGeometry& geometry,
                        const PoseMeasurements& measured);

}  // namespace armcal
