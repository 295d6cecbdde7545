#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "model/dynamics/joint_controller.h"
#include "model/robot/robot.h"

namespace armcal {

// A motion to follow, at rest before 0 and from `duration` on.
struct ReferenceMotion {
  double duration = 0;  // s
  std::function<ReferencePoint(double t)> at;
};

// How much of what the arm can do a built-in motion uses.
struct MotionOptions {
  double duration = 20;  // s
  // Of each joint's range: its limits, or +-1.5 rad or +-0.2 m where it has
  // none or wider ones.
  double size = .8;
  // Of each joint's speed: its limit, at most 2 rad/s or 0.5 m/s.
  double speed = 1;
  std::vector<int> joints;  // that move, from 0; empty: all
  uint64_t seed = 0;        // of the robot
  uint64_t run = 0;         // which of its motions
};

// Five harmonics of a base frequency of 0.1 Hz, random amplitudes and phases, a
// second of smooth onset and end. What lies between repeats every 10 s.
ReferenceMotion FourierMotion(const Robot& robot, const MotionOptions& options);
// Moves between random positions, each of fifth order in time and followed by a
// rest of 0.3 s.
ReferenceMotion PointToPointMotion(const Robot& robot,
                                   const MotionOptions& options);

// The motion after and before a standstill, s.
ReferenceMotion WithStandstill(const ReferenceMotion& motion, double before,
                               double after);

}  // namespace armcal
