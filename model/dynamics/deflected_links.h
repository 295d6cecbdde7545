#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/dynamics/deflection.h"
#include "model/dynamics/rigid_torque.h"
#include "model/dynamics/simulated_robot.h"
#include "model/robot/robot.h"
#include "model/signals/motion.h"

namespace armcal {

// A robot whose motors move as recorded, and what lies between them and its
// links.
struct LinksBehindDrives {
  const Robot* robot;
  const std::vector<Transmission>* transmissions;
  // What the links would need did they move with the motors, samples x n, N m
  // or N (LinkTorque). Robots of the same links share the matrix.
  const Eigen::MatrixXd* load;
};

// How such links move, and what they need for it.
struct DeflectedLinks {
  Eigen::MatrixXd change;   // beyond the load, samples x n, N m or N
  std::vector<int> joints;  // of the transmissions
  std::vector<Deflection> deflections;  // of each of them
};

// Of each: the deflections' equations of motion (deflection.h) under its load,
// with these slopes, then inverse dynamics of the links where they are. Those
// that have the same load and the same springs have the same answer, which is
// worked out once; springs of all others are followed together.
std::vector<std::shared_ptr<const DeflectedLinks>> FollowLinks(
    const std::vector<LinksBehindDrives>& arms, const Motion& motion,
    const LinkTorqueSlopes& slopes);

}  // namespace armcal
