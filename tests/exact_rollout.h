#pragma once

#include <Eigen/Core>

#include "model/arm_dynamics.h"
#include "model/arm_plan.h"
#include "model/forward_dynamics.h"
#include "model/integration.h"
#include "model/robot.h"

namespace armcal {

// A block of `mass` kg on a horizontal slide.
inline Robot HorizontalSlide(double mass) {
  Robot robot;
  Link link;
  link.joint.type = JointType::kPrismatic;
  link.X_PF.linear() =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()).matrix();
  link.inertial = InertialParameters::FromCenterOfMass(
      mass, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity());
  robot.links = {link};
  return robot;
}

// q, qd and states of Coulomb friction (from 0 on) after `duration` under a
// constant torque: an engine's terms and the joints' laws as joint_term.h
// writes them, by adaptive steps of 1e-13.
inline Eigen::VectorXd ExactEnd(const RolloutArm& arm, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::VectorXd& tau, double duration,
                                ArmDynamics* engine) {
  const int n = arm.robot.num_joints();
  Eigen::VectorXd x0(3 * n);
  x0 << q, qd, Eigen::VectorXd::Zero(n);
  IntegrationOptions options;
  options.relative = options.absolute = 1e-13;
  ArmTerms terms;
  const auto rate = [&](double, const Eigen::VectorXd& x, Eigen::VectorXd* dx) {
    const Eigen::VectorXd at = x.head(n), rates = x.segment(n, n);
    engine->Evaluate(at, rates, {}, &terms);
    Eigen::VectorXd net = tau - terms.bias;
    for (int j = 0; j < n; ++j) {
      const Joint& joint = arm.robot.links[j].joint;
      const CoulombTransition transition =
          arm.transitions.empty() ? CoulombTransition() : arm.transitions[j];
      const JointSpring spring =
          arm.springs.empty() ? JointSpring() : arm.springs[j];
      net[j] -= FrictionTorque(joint, transition, rates[j], x[2 * n + j]) +
                spring.stiffness * (at[j] - spring.rest);
      terms.mass_matrix(j, j) += joint.armature;
      (*dx)[2 * n + j] = transition.StateRate(rates[j], x[2 * n + j]);
    }
    dx->head(n) = rates;
    dx->segment(n, n) = SolveInertia(terms.mass_matrix, net);
  };
  return Integrate(rate, x0, 0, {duration}, options).x.row(0).transpose();
}

}  // namespace armcal
