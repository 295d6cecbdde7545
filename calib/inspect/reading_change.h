#pragma once

#include <Eigen/Core>

#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// How a log, and the robot's posture, are to be understood.
struct LogReading {
  Wiring wiring;
  bool degrees = false;     // positions of rotating joints
  Eigen::Vector3d gravity;  // in W, m/s^2; 0: torques hold no gravity
  double delay = 0;         // of torques behind positions, s

  explicit LogReading(const Robot& robot)
      : wiring(robot.num_joints()), gravity(robot.gravity) {}
};

// One thing by which the best reading differs from the log as it is.
struct ReadingChange {
  enum class Kind {
    kExchanged,     // two joints' columns
    kPositionSign,  // of one joint
    kTorqueSign,
    kJointSign,  // of both
    kDegrees,
    kGravity,  // has another direction, or is missing
    kDelay
  };
  Kind kind;
  int joint = -1, other = -1;  // from 0
  double gain = 0;             // nats of TorqueFit::Misfit
  // What a fit leaves of torques that it has not seen, before and after.
  double held_out_before = 0, held_out_after = 0;  // %
  double probability = 1;  // against the other changes that were tried
  // Of a position's or torque's sign: whether that of the other would do as
  // well, since nothing tells which way the joint turns.
  bool or_other_sign = false;
};

}  // namespace armcal
