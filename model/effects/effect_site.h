#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/simulated_robot.h"
#include "model/robot/robot.h"

namespace armcal {
// Inline, because the truth of blind tests (model/plant/hidden/) has classes of
// the same names: linked into one program as one name they would be one class.
inline namespace effects {

// What the joints do on a log: what sizes, ranges and grids of effects are
// relative to. One entry per joint.
struct MotionScale {
  Eigen::VectorXd torque;        // rms, N m or N
  Eigen::VectorXd load;          // rms of what moves the links, N m or N
  Eigen::VectorXd speed;         // rms while moving, rad/s or m/s
  Eigen::VectorXd top_speed;     // rad/s or m/s
  Eigen::VectorXd acceleration;  // rms, rad/s^2 or m/s^2
  Eigen::VectorXd low, high;     // positions, rad or m
  // As recorded, its largest, N m or N; empty: not known.
  Eigen::VectorXd top_torque;
  // The speed within which the joint's Coulomb friction changes sign, rad/s or
  // m/s: tanh(qd / width).
  Eigen::VectorXd width;
  // As recorded temperatures say; empty: not recorded.
  std::vector<JointThermal> thermal;
  // Whether a joint swung freely in all logs, its drive doing next to nothing;
  // empty: none did.
  std::vector<bool> swings;
  double begin = 0, end = 0;  // s
};

// Where an effect acts, on which robot and in which motion.
struct EffectSite {
  const Robot* robot;  // without the effect
  int joint;           // from 0; -1: the whole robot
  const MotionScale* scale;

  const Joint& at() const { return robot->links[joint].joint; }
};

}  // namespace effects
}  // namespace armcal
