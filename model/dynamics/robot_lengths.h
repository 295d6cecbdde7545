#pragma once

#include <vector>

#include "model/dynamics/proximal_chain.h"
#include "model/robot/robot.h"

namespace armcal {

// `robot` with other lengths between its joint axes: all beyond joint
// `length.joint` moves along x (a) or z (d) of that joint's proximal frame
// until MakeProximalChain has `length.value` there. Directions of axes and the
// zeros of joints stay.
//
// A DH table stays one: the number that changes is the table's own, hence for
// the standard convention the link's frame moves (X_ML), for the modified one
// the next joint (a, X_PF) or the link's frame along its axis (d, X_ML). Of
// other robots the next joint's frame moves on its link (X_PF: URDF's origin).
// Inertial parameters keep their numbers, which are about the link's frame:
// where this moves, the body moves with it.
//
// Axes within 0.02 rad of parallel that are no DH row have no d of their own
// (ProximalChain): it moves the arm but counts into the next joint's d, and
// an a that is given a negative value turns their common normal around.
Robot WithLengths(const Robot& robot, const std::vector<Length>& lengths);

}  // namespace armcal
