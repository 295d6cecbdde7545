#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "model/dynamics/arm_dynamics.h"
#include "model/robot/robot.h"

namespace armcal {

// A robot that can be simulated with what rigid bodies lack. Each slot takes
// plain callbacks, so that whoever writes an effect needs to know nothing of
// the engine or the integrator, and the simulator nothing of effects.
//
// A joint's drive is a motor behind a gear, referred to the joint side: its
// position and velocity are those of the link plus what the transmission
// yields. Where no transmission is given the motor is bound to its link and the
// armature is added to the mass matrix.
//
// A law may carry states of its own: `state` and `rate` point to as many
// numbers as initial_state holds; the law writes every rate. Laws are called
// several times per step and must have no memory besides.

// All that laws can see, one entry per joint of the robot.
struct ArmInstant {
  double t = 0;                   // s
  Eigen::VectorXd position;       // of the motors, rad or m
  Eigen::VectorXd velocity;       // rad/s or m/s
  Eigen::VectorXd link_position;  // the same where the joint is rigid
  Eigen::VectorXd link_velocity;
  // What the drive hands to its link: the torque that moves the link, without
  // what friction and armature take. Of the substep before, N m or N.
  Eigen::VectorXd load;
  Eigen::VectorXd temperature;  // of the joint above its surroundings, K
};

// A torque on one joint, on the motor side: friction (against the motion),
// ripple, a spring.
struct JointLaw {
  int joint = 0;
  Eigen::VectorXd initial_state;
  bool heats = false;  // friction: its power warms the joint
  std::function<double(const ArmInstant& instant, const double* state,
                       double* rate)>
      torque;  // N m or N
  // Whether it looks at link_position or link_velocity. Of those that do not,
  // what lies behind the motors changes nothing.
  bool sees_link = false;
  // Laws of one number are copies of one law, whose torque along a motion is
  // worked out once for all of them; -1: it has none.
  int copy_of = -1;
};

// What lies between a motor and its link: the torque on the link (the motor
// gets its negative) from the deflection motor - link and its rate.
struct Transmission {
  int joint = 0;  // needs armature > 0, the motor's own inertia
  Eigen::VectorXd initial_state;
  std::function<double(double deflection, double deflection_rate,
                       const double* state, double* rate)>
      torque;  // N m or N
  // At rest under a load in N m or N, rad or m: where the start is. Empty: 0.
  std::function<double(double load)> initial_deflection;
  // Largest slope of the torque, N m/rad or N/m, of a law that stiffens, as a
  // contact does. 0: it is about that at the start.
  double stiffest = 0;
};

// Force and moment of the environment on a link, at an attachment.
struct PointInstant {
  double t = 0;
  Eigen::Isometry3d X_WP;  // axes of the link, origin at the attachment
  Eigen::Vector3d w_WP;    // rad/s
  Eigen::Vector3d v_WP;    // m/s
};
struct Wrench {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m, in W
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N, in W
};
struct WrenchLaw {
  Attachment attachment;
  // From the attachment at rest at the start.
  std::function<Eigen::VectorXd(const Eigen::Isometry3d& X_WP)> initial_state;
  int num_states = 0;
  std::function<Wrench(const PointInstant& instant, const double* state,
                       double* rate)>
      wrench;
};

// From the torque that the controller commands (and the log records) to the one
// that the motors give; n entries, N m or N. Maps apply one after the other.
struct ActuatorMap {
  Eigen::VectorXd initial_state;
  std::function<void(const ArmInstant& instant, const double* state,
                     double* rate, Eigen::VectorXd* torque)>
      apply;
};

// What sensors say, before resolution and noise.
struct Reading {
  Eigen::VectorXd position;     // rad or m; the controller sees it too
  Eigen::VectorXd velocity;     // rad/s or m/s; the controller sees it too
  Eigen::VectorXd torque;       // N m or N, as recorded
  Eigen::VectorXd temperature;  // deg C
};
struct SensorMap {
  std::function<void(const ArmInstant& instant, Reading* reading)> apply;
};

// A joint as one heat capacity.
struct JointThermal {
  double capacity = 2000;   // J/K
  double resistance = 0.5;  // K/W to the surroundings
  // Warmth T leaves exp(-fall T) of its friction, 1/K: so along a recorded
  // motion. A simulator's laws of friction know themselves.
  double viscous_fall = 0, coulomb_fall = 0;
};

struct SimulatedRobot {
  // Its friction is not applied by itself: a law has to. Armature is.
  Robot robot;
  // Leading joints of `robot` that nothing drives or measures, such as those of
  // a base that sways. Logs and controllers hold the others.
  int num_passive = 0;
  std::vector<JointLaw> joint_laws;
  std::vector<Transmission> transmissions;  // at most one per joint
  std::vector<WrenchLaw> wrenches;
  std::vector<ActuatorMap> actuators;
  std::vector<SensorMap> sensors;
  double torque_delay = 0;  // s, the recorded torque is that much older
  // The stamp that the log gives to time t, s. Empty: t itself.
  std::function<double(double)> clock;
  // What share of the unevenness of recorded stamps is the clock's, where a log
  // is looked at; the rest is when samples were taken.
  double clock_unevenness = 0;
  std::vector<JointThermal> thermal;  // per joint; empty: the default
  double ambient = 25;                // deg C
};

}  // namespace armcal
