#pragma once

#include <Eigen/Core>

#include "model/robot/robot.h"

namespace armcal {

// Motion of a body's frame B, expressed in B; the acceleration is that of Bo
// relative to free fall: a body at rest has -g.
struct RigidMotion {
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();         // rad/s
  Eigen::Vector3d alpha = Eigen::Vector3d::Zero();         // rad/s^2
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // m/s^2
};

// What moves a body so, N and N m, the moment about Bo, both expressed in B.
struct RigidWrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

// Newton's and Euler's laws about Bo, with the body's mass m, first moment h
// and inertia I in B:
//   force  = m a + alpha x h + omega x (omega x h),
//   moment = I alpha + omega x I omega + h x a.
// Linear in the parameters.
RigidWrench WrenchOf(const InertialParameters& body, const RigidMotion& motion);

// Of the last link's frame L. The vectors have n entries, as in
// InverseDynamics(), and the robot is a chain.
RigidMotion LastLinkMotion(const Robot& robot, const Eigen::VectorXd& q,
                           const Eigen::VectorXd& qd,
                           const Eigen::VectorXd& qdd);

// Joint torques (N m, or N for prismatic joints) that move the rigid arm with
// qdd at (q, qd): recursive Newton-Euler (Luh, Walker, Paul 1980). Gravity and
// the links' inertial parameters are the robot's; friction and armature are
// not included. All vectors have n entries. Shares no code with
// model_parameters, which it is the referee of.
Eigen::VectorXd InverseDynamics(const Robot& robot, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& qd,
                                const Eigen::VectorXd& qdd);

}  // namespace armcal
