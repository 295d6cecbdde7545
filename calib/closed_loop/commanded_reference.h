#pragma once

#include <Eigen/Core>

#include "calib/closed_loop/replay.h"
#include "model/dynamics/batch_inverse_dynamics.h"
#include "model/dynamics/joint_controller.h"
#include "model/plant/reference_motion.h"
#include "model/robot/robot.h"

namespace armcal {

// What a controller is told to follow at its periods, a row each.
struct ReferenceSeries {
  Eigen::MatrixXd q, qd, qdd;                     // rad, rad/s, rad/s^2, or m
  Eigen::MatrixXd feedforward, feedforward_rate;  // N m or N, and per s
};

// The command of a log as the controller has it, whose feedforward knows the
// robot `known`.
class CommandedReference {
 public:
  CommandedReference(const Robot& known, Feedforward feedforward,
                     const CommandedLog& log);

  // At `count` instants from `begin` on, `period` s apart, of a command that
  // arrives `delay` s late.
  ReferenceSeries At(double begin, double period, long count,
                     double delay) const;

 private:
  Eigen::MatrixXd FeedforwardTorque(const Eigen::MatrixXd& q,
                                    const Eigen::MatrixXd& qd,
                                    const Eigen::MatrixXd& qdd) const;

  Robot known_;
  Feedforward feedforward_;
  BatchInverseDynamics dynamics_;
  ReferenceMotion motion_;
};

}  // namespace armcal
