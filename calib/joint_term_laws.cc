#include "calib/joint_term_laws.h"

namespace armcal {

void AddJointTerms(int j, const std::vector<CoulombPart>& coulomb,
                   SimulatedRobot* plant) {
  const Joint& joint = plant->robot.links[j].joint;
  JointLaw friction;
  friction.joint = j;
  friction.heats = true;
  friction.initial_state = Eigen::VectorXd::Zero(coulomb.size());
  friction.torque = [j, viscous = joint.viscous, coulomb](
                        const ArmInstant& instant, const double* state,
                        double* rate) {
    const double qd = instant.velocity[j];
    double torque = viscous * qd;
    for (size_t k = 0; k < coulomb.size(); ++k) {
      const CoulombTransition& transition = coulomb[k].transition;
      torque += coulomb[k].force * transition.C(qd, state[k]);
      rate[k] = transition.StateRate(qd, state[k]);
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
