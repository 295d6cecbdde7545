#pragma once

#include <vector>

#include "model/dynamics/joint_term.h"
#include "model/dynamics/simulated_robot.h"

namespace armcal {

// A part of a joint's Coulomb friction and how it changes sign. Torque is
// sum of force * c: several parts make any odd curve through zero velocity.
struct CoulombPart {
  double force;  // N m or N
  CoulombTransition transition;
};

// Gives joint j of `plant` the joint terms that a simulated robot does not have
// by itself: viscous friction and offset of its `robot`, and these parts of
// Coulomb friction. The work of friction warms the joint.
void AddJointTerms(int j, const std::vector<CoulombPart>& coulomb,
                   SimulatedRobot* plant);

}  // namespace armcal
