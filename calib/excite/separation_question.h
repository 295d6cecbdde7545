#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/model_parameters.h"
#include "model/effects/effects.h"
#include "model/robot/robot.h"
#include "problems/motion_limits.h"

namespace armcal {

// What is asked: effects whose torque is linear in a size. Throws
// std::invalid_argument where one is not, or no joint of the robot shows it.
struct SeparationQuestion {
  SeparationQuestion(const Robot& robot, const std::vector<const Effect*>& list,
                     const ModelParameters& model, const MotionLimits& limits);

  struct Column {
    const Effect* effect;
    int joint, parameter;
    Eigen::VectorXd p;  // with this one of its usual size, no other
    double size;
  };
  MotionScale scale;  // of a motion with half of the velocities
  std::vector<Column> columns;
  std::vector<JointType> joint_types;
};

}  // namespace armcal
