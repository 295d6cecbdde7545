#include "model/plant/joint_controller.h"

#include <algorithm>
#include <cmath>

#include "model/forward_dynamics.h"
#include "model/input_text.h"
#include "model/inverse_dynamics.h"
#include "model/yaml_node.h"

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

void ReadVector(const YamlNode& node, const std::string& key,
                const std::string& unit, Eigen::VectorXd* value) {
  const auto child = node.Child(key);
  if (!child) return;
  const Eigen::VectorXd read = child->Vector(unit);
  if (read.size() != value->size()) {
    child->Refuse("expected " + std::to_string(value->size()) +
                  " numbers, one per joint, in " + unit);
  }
  if (read.minCoeff() < 0) child->Refuse("expected numbers of at least 0");
  *value = read;
}

double ReadPositive(const YamlNode& node, const std::string& key,
                    const std::string& unit, double value) {
  const auto child = node.Child(key);
  if (!child) return value;
  const double read = child->Number(unit);
  if (read <= 0) child->Refuse("expected a number above 0, in " + unit);
  return read;
}

}  // namespace

ControllerOptions DefaultController(const Robot& robot,
                                    const Eigen::VectorXd& q,
                                    double bandwidth_hz) {
  const double omega = 2 * M_PI * bandwidth_hz;
  const Eigen::VectorXd inertia = JointInertia(robot, q);
  ControllerOptions options;
  options.kp = omega * omega * inertia;
  options.kd = 2 * omega * inertia;
  options.ki = omega / 5 * options.kp;
  options.torque_limit.resize(robot.num_joints());
  for (int j = 0; j < robot.num_joints(); ++j) {
    options.torque_limit[j] = robot.links[j].joint.effort;
  }
  return options;
}

ControllerOptions ReadController(const std::string& path, const Robot& robot,
                                 const Eigen::VectorXd& q) {
  const YamlNode node = YamlNode::ReadFile(path);
  node.ExpectKeys({"rate", "bandwidth", "kp", "kd", "ki", "torque_limit",
                   "velocity_filter", "feedforward"});
  ControllerOptions options = DefaultController(
      robot, q, ReadPositive(node, "bandwidth", "Hz", kUsualBandwidthHz));
  options.rate_hz = ReadPositive(node, "rate", "Hz", options.rate_hz);
  if (options.rate_hz < 1 || options.rate_hz > kFastestHz) {
    node.RequiredChild("rate").Refuse("expected a rate from 1 to " +
                                      NumberText(kFastestHz) + " Hz");
  }
  options.velocity_filter_hz =
      ReadPositive(node, "velocity_filter", "Hz", options.velocity_filter_hz);
  ReadVector(node, "kp", "N m/rad (N/m)", &options.kp);
  ReadVector(node, "kd", "N m s/rad (N s/m)", &options.kd);
  ReadVector(node, "ki", "N m/(rad s) (N/(m s))", &options.ki);
  ReadVector(node, "torque_limit", "N m (N)", &options.torque_limit);
  if (const auto child = node.Child("feedforward")) {
    const std::string name =
        child->Choice({"none", "gravity", "inverse_dynamics"});
    options.feedforward = name == "none"      ? Feedforward::kNone
                          : name == "gravity" ? Feedforward::kGravity
                                              : Feedforward::kInverseDynamics;
  }
  return options;
}

DifferencedVelocity::DifferencedVelocity(const ControllerOptions& options)
    : rate_hz_(options.rate_hz),
      decay_(
          std::exp(-2 * M_PI * options.velocity_filter_hz / options.rate_hz)) {}

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
  const Eigen::VectorXd error = reference.q - position;
  Eigen::VectorXd torque =
      FeedforwardTorque(reference) + options_.kp.cwiseProduct(error) +
      options_.kd.cwiseProduct(reference.qd - velocity) + integral_;
  for (int j = 0; j < torque.size(); ++j) {
    const double limit = options_.torque_limit[j];
    const bool pushes =
        std::abs(torque[j]) >= limit && torque[j] * error[j] > 0;
    if (!pushes) integral_[j] += options_.ki[j] * error[j] / options_.rate_hz;
    torque[j] = std::clamp(torque[j], -limit, limit);
  }
  return torque;
}

}  // namespace armcal
