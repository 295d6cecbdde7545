#include "model/dynamics/joint_controller.h"

#include <cmath>

#include "model/dynamics/drive_filters.h"
#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"

namespace armcal {

namespace {

// Of each joint alone, armature included.
Eigen::VectorXd JointInertia(const Robot& robot, const Eigen::VectorXd& q) {
  Eigen::VectorXd inertia = MassMatrix(robot, q).diagonal();
  for (int j = 0; j < robot.num_joints(); ++j) {
    inertia[j] += robot.links[j].joint.armature;
  }
  return inertia;
}

}  // namespace

void SetIntegralGain(DriveKind kind, double bandwidth_hz, DriveLaw* law) {
  const double omega = 2 * M_PI * bandwidth_hz;
  if (kind == DriveKind::kPd) law->ki = omega / 5 * law->kp;
  if (kind == DriveKind::kCascade) law->velocity_ki = omega * law->kd;
}

// Gains for a joint of inertia I as if it were alone: kp = w^2 I and kd = 2 w I
// put both poles at -w (critical damping), and a slow integral. A cascade has a
// velocity loop four times as fast as its position loop.
ControllerOptions DefaultController(const Robot& robot,
                                    const Eigen::VectorXd& q,
                                    double bandwidth_hz, DriveKind kind) {
  const double omega = 2 * M_PI * bandwidth_hz;
  const Eigen::VectorXd inertia = JointInertia(robot, q);
  ControllerOptions options;
  options.kind = kind;
  if (kind != DriveKind::kPd) options.feedforward = Feedforward::kNone;
  for (int j = 0; j < robot.num_joints(); ++j) {
    DriveLaw law;
    if (kind == DriveKind::kCascade) {
      law.kd = 4 * omega * inertia[j];
      law.position_gain = omega;
    } else {
      law.kp = omega * omega * inertia[j];
      law.kd = 2 * omega * inertia[j];
    }
    SetIntegralGain(kind, bandwidth_hz, &law);
    if (kind == DriveKind::kP) law.velocity_feedforward = 0;
    law.torque_limit = robot.links[j].joint.effort;
    options.drives.push_back(law);
  }
  return options;
}

DifferencedVelocity::DifferencedVelocity(const ControllerOptions& options)
    : rate_hz_(options.rate_hz),
      decay_(LowPassDecay(options.velocity_filter_hz, options.rate_hz)) {}

const Eigen::VectorXd& DifferencedVelocity::Update(
    const Eigen::VectorXd& position) {
  if (last_position_.size() == 0) {
    velocity_ = Eigen::VectorXd::Zero(position.size());
  } else {
    velocity_ = decay_ * velocity_ +
                (1 - decay_) * rate_hz_ * (position - last_position_);
  }
  last_position_ = position;
  return velocity_;
}

JointController::JointController(const ControllerOptions& options,
                                 const Robot& model)
    : options_(options),
      model_(model),
      integral_(Eigen::VectorXd::Zero(model.num_joints())) {}

Eigen::VectorXd JointController::FeedforwardTorque(
    const ReferencePoint& reference) const {
  const int n = model_.num_joints();
  if (options_.feedforward == Feedforward::kNone) {
    return Eigen::VectorXd::Zero(n);
  }
  if (options_.feedforward == Feedforward::kGravity) {
    return GravityTorque(model_, reference.q);
  }
  Eigen::VectorXd tau =
      InverseDynamics(model_, reference.q, reference.qd, reference.qdd);
  for (int j = 0; j < n; ++j) {
    const Joint& joint = model_.links[j].joint;
    tau[j] +=
        joint.armature * reference.qdd[j] + joint.viscous * reference.qd[j];
  }
  return tau;
}

Eigen::VectorXd JointController::Update(const ReferencePoint& reference,
                                        const Eigen::VectorXd& position,
                                        const Eigen::VectorXd& velocity) {
  return Update(reference, FeedforwardTorque(reference), position, velocity);
}

Eigen::VectorXd JointController::Update(const ReferencePoint& reference,
                                        const Eigen::VectorXd& feedforward,
                                        const Eigen::VectorXd& position,
                                        const Eigen::VectorXd& velocity) {
  Eigen::VectorXd torque(integral_.size());
  at_limit_ = false;
  for (int j = 0; j < torque.size(); ++j) {
    const DriveOutput out = Drive(options_.drives[j],
                                  {reference.q[j], reference.qd[j],
                                   feedforward[j], position[j], velocity[j]},
                                  integral_[j]);
    torque[j] = out.torque;
    integral_[j] += out.integral_rate / options_.rate_hz;
    at_limit_ = at_limit_ || out.torque_limited;
  }
  return torque;
}

}  // namespace armcal
