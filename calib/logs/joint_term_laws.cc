#include "calib/logs/joint_term_laws.h"

#include <algorithm>

namespace armcal {
namespace {

// States of parts, none where friction remembers nothing.
int NumStates(const std::vector<CoulombPart>& coulomb) {
  const bool remembers =
      std::any_of(coulomb.begin(), coulomb.end(), [](const CoulombPart& part) {
        return part.transition.law == CoulombTransition::Law::kDisplacement;
      });
  return remembers ? static_cast<int>(coulomb.size()) : 0;
}

}  // namespace

void AddJointTerms(int j, const std::vector<CoulombPart>& coulomb,
                   SimulatedRobot* plant) {
  const Joint& joint = plant->robot.links[j].joint;
  JointLaw friction;
  friction.joint = j;
  friction.heats = true;
  const int states = NumStates(coulomb);
  friction.initial_state = Eigen::VectorXd::Zero(states);
  friction.torque = [j, viscous = joint.viscous, coulomb, states](
                        const ArmInstant& instant, const double* state,
                        double* rate) {
    const double qd = instant.velocity[j];
    double torque = viscous * qd;
    for (size_t k = 0; k < coulomb.size(); ++k) {
      const CoulombTransition& transition = coulomb[k].transition;
      const double at = states > 0 ? state[k] : 0;
      torque += coulomb[k].force * transition.C(qd, at);
      if (states > 0) rate[k] = transition.StateRate(qd, at);
    }
    return -torque;
  };
  plant->joint_laws.push_back(friction);
  if (joint.offset == 0) return;
  plant->joint_laws.push_back(
      {j,
       {},
       false,
       [offset = joint.offset](const ArmInstant&, const double*, double*) {
         return -offset;
       }});
}

}  // namespace armcal
