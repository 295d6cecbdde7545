#include "tests/blind/withheld_effect.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/dynamics/inverse_dynamics.h"
#include "model/robot/kinematics.h"
#include "tests/blind/real_log.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

double Uniform(std::mt19937_64* random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(*random);
}

// Velocity of the arm at a log's own rows, and what else its smooth motion
// says.
struct SmoothMotion {
  explicit SmoothMotion(const Log& log)
      : uniform(UniformLog(log)), motion(RealMotion(uniform)) {}
  MatrixXd At(const MatrixXd& x, const Log& log) const {
    return Interpolate(uniform.t, x, log.t);
  }
  Log uniform;
  PlantMotion motion;
};

// Torque for a point mass (kg) at com (m, in the last link's frame).
MatrixXd PayloadTorque(const Robot& robot, double mass, const Vector3d& com,
                       const Log& log) {
  const SmoothMotion smooth(log);
  Robot loaded = robot;
  const double size = std::cbrt(std::abs(mass) / 7850);  // a cube of steel
  loaded.links.back().inertial += InertialParameters::FromCenterOfMass(
      mass, com, mass * size * size / 6 * Eigen::Matrix3d::Identity());
  MatrixXd tau(smooth.motion.q.rows(), robot.num_joints());
  for (int k = 0; k < tau.rows(); ++k) {
    const VectorXd q = smooth.motion.q.row(k), qd = smooth.motion.qd.row(k),
                   qdd = smooth.motion.qdd.row(k);
    tau.row(k) = InverseDynamics(loaded, q, qd, qdd) -
                 InverseDynamics(robot, q, qd, qdd);
  }
  return smooth.At(tau, log);
}

// A force of the environment on the tool that rises like a half sine, stays,
// and falls: shape = time of its middle, whole duration (s), direction in W.
MatrixXd ContactTorque(const Robot& robot, const WithheldEffect& effect,
                       const Log& log) {
  const double middle = effect.shape[0], half = effect.shape[1] / 2;
  const Vector3d force = effect.size * effect.shape.tail<3>();
  MatrixXd tau = MatrixXd::Zero(log.size(), robot.num_joints());
  for (int k = 0; k < log.size(); ++k) {
    const double x = std::abs(log.t[k] - middle) / half;
    if (x >= 1) continue;
    const double share = std::min(1., 1.5 * std::cos(M_PI / 2 * x));
    // Virtual work: the motors hold against J' f.
    for (int j = 0; j < tau.cols(); ++j) {
      constexpr double kStep = 1e-6;
      VectorXd q = log.q.row(k);
      q[j] += kStep;
      const Vector3d ahead = ToolPose(robot, q).translation();
      q[j] -= 2 * kStep;
      const Vector3d behind = ToolPose(robot, q).translation();
      tau(k, j) = -share * force.dot(ahead - behind) / (2 * kStep);
    }
  }
  return tau;
}

// On one joint: a change of friction, or a torque of its position.
VectorXd JointTorqueOf(const WithheldEffect& effect, const Log& log) {
  const SmoothMotion smooth(log);
  const VectorXd v = smooth.At(smooth.motion.qd, log).col(effect.joint);
  if (effect.name == "viscous_friction") return effect.size * v;
  if (effect.name == "coulomb_friction") {
    constexpr double kZeroVelocity = .01;  // rad/s
    return effect.size * (v.array() / kZeroVelocity).atan() * (2 / M_PI);
  }
  const Eigen::ArrayXd f =
      effect.shape[0] * log.q.col(effect.joint).array() + effect.shape[1];
  return effect.size * (f.sin() + .2 * (2 * f).sin());
}

}  // namespace

const std::vector<std::string>& WithheldEffectNames() {
  static const std::vector<std::string> kNames = {
      "encoder_offset", "torque_gain",      "delay",
      "time_base",      "external_contact", "payload",
      "torque_ripple",  "coulomb_friction", "viscous_friction"};
  return kNames;
}

std::vector<NamedValue> WithheldEffect::Values() const {
  if (name == "encoder_offset") return {{"offset", "rad", size}};
  if (name == "torque_gain") return {{"gain", "1", size}};
  if (name == "delay") return {{"delay", "s", size}};
  if (name == "time_base") return {{"rate", "1", size}};
  if (name == "viscous_friction") return {{"viscous", "N m s/rad", size}};
  if (name == "coulomb_friction") return {{"coulomb", "N m", size}};
  if (name == "torque_ripple") {
    return {{"ripple", "N m", size}, {"harmonic", "1/rad", shape[0]}};
  }
  if (name == "payload") {
    return {{"mass", "kg", size},
            {"com_x", "m", shape[0]},
            {"com_y", "m", shape[1]},
            {"com_z", "m", shape[2]}};
  }
  CHECK_EQ(name, "external_contact");
  return {{"force", "N", size}, {"time", "s", shape[0]}};
}

WithheldEffect DrawWithheldEffect(const std::string& name, const Robot& robot,
                                  const VectorXd& usual, double duration,
                                  std::mt19937_64* random) {
  WithheldEffect effect;
  effect.name = name;
  const bool whole = name == "delay" || name == "time_base" ||
                     name == "external_contact" || name == "payload";
  // Where an effect does not show (zeros of many first and last joints), its
  // ENR says so and it is drawn again.
  if (!whole) {
    effect.joint =
        std::uniform_int_distribution<int>(0, robot.num_joints() - 1)(*random);
  }
  const double sign = Uniform(random, -1, 1) < 0 ? -1 : 1;
  const bool positive = name == "payload" || name == "external_contact" ||
                        name == "torque_ripple";
  effect.size = positive ? 1 : sign;
  if (name == "external_contact") {
    std::normal_distribution<double> normal;
    const Vector3d n(normal(*random), normal(*random), normal(*random));
    effect.shape.resize(5);
    effect.shape << Uniform(random, .2, .8) * duration,
        std::exp(Uniform(random, std::log(.5), std::log(2.5))), n.normalized();
  } else if (name == "payload") {
    const Vector3d com(Uniform(random, -.1, .1), Uniform(random, -.1, .1),
                       Uniform(random, .03, .15));
    effect.shape = robot.X_LT * com;
  } else if (name == "torque_ripple") {
    effect.shape.resize(2);
    effect.shape << std::round(
        std::exp(Uniform(random, std::log(6.), std::log(40.)))),
        Uniform(random, 0, 2 * M_PI);
  }
  const SizeRange range = RangeOf(effect, usual);
  effect.size *= std::sqrt(range.least * range.most);
  return effect;
}

SizeRange RangeOf(const WithheldEffect& effect, const VectorXd& usual) {
  const double torque = usual[std::max(0, effect.joint)];
  if (effect.name == "encoder_offset") return {1e-4, .3};
  if (effect.name == "torque_gain") return {1e-3, .8};
  if (effect.name == "delay") return {1e-4, .08};
  if (effect.name == "time_base") return {1e-4, .2};
  if (effect.name == "payload") return {.002, 15};
  if (effect.name == "external_contact") return {.02, 300};
  return {5e-4 * torque, 1.5 * torque};
}

Log WithEffect(const Robot& robot, const WithheldEffect& effect,
               const Log& log) {
  Log changed = log;
  if (effect.name == "encoder_offset") {
    changed.q.col(effect.joint).array() += effect.size;
  } else if (effect.name == "torque_gain") {
    changed.tau.col(effect.joint) *= 1 + effect.size;
  } else if (effect.name == "delay") {
    // Motors give what was recorded this much later.
    const VectorXd later = log.t.array() + effect.size;
    changed.tau = Interpolate(log.t, log.tau, later);
  } else if (effect.name == "time_base") {
    changed.t = (1 + effect.size) * log.t;
  } else if (effect.name == "payload") {
    changed.tau +=
        PayloadTorque(robot, effect.size, effect.shape.head<3>(), log);
  } else if (effect.name == "external_contact") {
    changed.tau += ContactTorque(robot, effect, log);
  } else {
    changed.tau.col(effect.joint) += JointTorqueOf(effect, log);
  }
  return changed;
}

}  // namespace armcal
