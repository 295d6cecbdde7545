#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "model/dynamics/simulated_robot.h"

namespace armcal {

using JointTorque = std::function<double(const ArmInstant& instant,
                                         const double* state, double* rate)>;

// What sizes are relative to: an effect is drawn as a share of what its joint
// does anyway. One entry per driven joint.
struct EffectContext {
  Eigen::VectorXd torque;   // N m or N, its rms in ordinary motion
  Eigen::VectorXd speed;    // rad/s or m/s
  Eigen::VectorXd inertia;  // kg m^2 or kg, that the joint feels
  // What changes within minutes is scaled by this time, which is the robot's:
  // all its logs have the same heat capacities and drifts.
  double time_scale = 40;  // s
  // Of this log, s: only for placing in it what comes and goes.
  double duration = 40;
  // Share of its speed within which a joint's friction changes sign.
  double zero_velocity = .005;
  std::uint64_t seed = 0;  // of whatever an effect draws when applied
  std::uint64_t run = 0;   // of what differs from one log to the next
};
// From the rigid robot at random states of 1 rad/s and 3 rad/s^2 (0.3 m/s and
// 0.9 m/s^2), and its joint friction.
EffectContext TypicalContext(const Robot& robot, std::uint64_t seed);

// A share of the joint's scale (unit 1) where that says more than SI units.
struct EffectParameter {
  enum class Draw { kUniform, kLog, kLogEitherSign };
  std::string name;
  std::string unit;
  double usual;
  double low, high;  // drawn from; with kLogEitherSign of |value|
  Draw draw;
  // Valid in, as far as the law keeps its sense: sizes that users ask for may
  // be rarer than those drawn.
  double least = low, most = high;
};

// What was applied, in SI units, for the label of a log.
struct EffectValue {
  std::string name;
  std::string unit;
  double value;
};

// Where an effect is to be applied.
struct EffectSite {
  SimulatedRobot* robot;
  int joint;  // of the driven ones, from 0; -1: the whole robot
  Eigen::VectorXd p;
  const EffectContext* context;

  int num_driven() const {
    return robot->robot.num_joints() - robot->num_passive;
  }
  int index() const { return robot->num_passive + joint; }
  // 1 for the last joint. Laws count from the tip: joints that another effect
  // puts under the base then shift nothing.
  int from_tip() const { return num_driven() - joint; }
  Link& link() const { return robot->robot.links[index()]; }
  JointType type() const { return link().joint.type; }
  double torque() const { return context->torque[joint]; }
  double speed() const { return context->speed[joint]; }
  // The displacement that counts as one radian: 0.3 m of a prismatic joint.
  double radian() const { return IsRotational(type()) ? 1 : .3; }
  double width() const { return context->zero_velocity * speed(); }
  std::string effort_unit() const { return EffortUnit(type()); }
  std::string position_unit() const { return PositionUnit(type()); }
  double moving_mass() const;  // kg, of the driven links
  // Of its own for each kind and joint: for what stays as it is, and for what
  // comes and goes in time, which no two logs have alike.
  std::mt19937_64 Random(const std::string& kind) const;
  std::mt19937_64 RandomInTime(const std::string& kind) const;
  // A law on this joint: friction, whose power warms it, or another torque.
  void AddFriction(const JointTorque& torque,
                   const Eigen::VectorXd& initial_state = {}) const;
  void AddTorque(const JointTorque& torque) const;
};

inline double FromTip(const Eigen::VectorXd& x, int k) {
  return x[x.size() - k];
}
inline double& FromTip(Eigen::VectorXd* x, int k) {
  return (*x)[x->size() - k];
}

// A kind of effect whose law differs on purpose from the one that estimation
// would use: to estimate with the very law that made the data would be an
// "inverse crime" and say nothing about real robots.
struct HiddenEffect {
  enum class Scope { kJoint, kRobot };
  std::string name;
  bool in_catalogue = true;  // model/effects has the name, too
  Scope scope = Scope::kJoint;
  std::string sentence;  // what it is and when it shows
  std::vector<EffectParameter> parameters;
  std::function<std::vector<EffectValue>(const EffectSite& site)> apply;
  // Empty, or why this joint of this robot cannot show it.
  std::function<std::string(const SimulatedRobot& robot, int joint)> unfit;
  // Of the rigid robot itself: to be applied before effects that act on it.
  bool changes_robot = false;
};

}  // namespace armcal
