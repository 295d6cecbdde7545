#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/robot/robot.h"
#include "model/signals/motion.h"
#include "problems/motion_information.h"

namespace armcal {

// What a motion must stay within, per joint; infinite where there is no limit.
struct MotionLimits {
  Eigen::VectorXd lower, upper;  // rad or m, finite
  Eigen::VectorXd velocity;      // rad/s or m/s
  Eigen::VectorXd acceleration;  // rad/s^2 or m/s^2
  Eigen::VectorXd effort;        // N m or N

  // All a share nearer to the middle.
  MotionLimits Within(double share) const;
  // The largest share of a limit that a motion with these torques uses, at
  // least 0; above 1 it breaks one.
  double Used(const Motion& motion, const Eigen::MatrixXd& torque) const;
};

// Those of the robot file. Where it has none: +-1.5 rad or +-0.2 m about zero,
// 1 rad/s or 0.25 m/s, three times the velocity in a second, and any effort;
// `assumed` gets a sentence for each.
MotionLimits LimitsOf(const Robot& robot, std::vector<std::string>* assumed);

// The mean over samples of -sum log(1 - (used share of a limit)^2): large near
// any limit, infinite beyond. Adds `factor` times its gradients.
double LimitBarrier(const MotionLimits& limits, const Motion& motion,
                    const Eigen::MatrixXd& torque, double factor,
                    MotionGradient* gradient, Eigen::MatrixXd* of_torque);

}  // namespace armcal
