#pragma once

#include <Eigen/Core>

#include "model/dynamics/simulated_robot.h"
#include "model/signals/motion.h"

namespace armcal {

// What the laws of a SimulatedRobot see along a recorded motion. Joints in
// rows, samples in columns, so that an instant is contiguous.
struct MotionTrack {
  Eigen::VectorXd t;           // s, true time of each sample
  Eigen::MatrixXd position;    // of the motors, rad or m
  Eigen::MatrixXd velocity;    // rad/s or m/s
  Eigen::MatrixXd load;        // N m or N
  Eigen::MatrixXd warmth;      // of the joint above its surroundings, K
  Eigen::MatrixXd deflection;  // motor - link, rad or m; empty: none
  Eigen::MatrixXd deflection_rate;

  int size() const { return static_cast<int>(position.cols()); }
  int num_joints() const { return static_cast<int>(position.rows()); }
  void SetMotion(const Motion& motion);
  // At sample k.
  void At(int k, ArmInstant* instant) const;
  // `share` (0 to 1) of the way from sample k to the next.
  void Between(int k, double share, ArmInstant* instant) const;
};

// Column k of x plus `share` of the way to the next, by the cubic whose slopes
// at samples are central differences (Catmull and Rom 1974): a kink at every
// sample would shake whatever follows x.
void InterpolateColumns(const Eigen::MatrixXd& x, int k, double share,
                        Eigen::VectorXd* at);

}  // namespace armcal
