#pragma once

#include <Eigen/Core>

#include "calib/closed_loop/replay.h"
#include "model/dynamics/joint_controller.h"
#include "model/log_files/log_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// The torque that drives of known gains gave, N m or N, at these times (s since
// the log's first row; rows of the result, joints in columns): the controller's
// own law, period by period, on the command and on the positions as they were
// measured, which is what it acted on. Behind the lag of the drives, and as the
// mean over an interval of the log, for it is constant within a period.
// `known` is the robot that the feedforward knows. Integrals begin at 0 with
// the log: where they did not, each joint's torque is off by a constant; and
// what logs leave out of the positions adds up in them.
Eigen::MatrixXd CommandedTorque(const Robot& known,
                                const ControllerOptions& controller,
                                const CommandedLog& commanded,
                                const Eigen::VectorXd& times);

// The same, and what makes it wrong: a draw (by `seed`) of noise as white and
// as large as that of the positions, which the tracking error tells, for it
// hardly changes between rows at uneven times or over lost ones; and a clock
// that stamps other times than those of the drives.
ReconstructedTorque ReconstructTorque(const Robot& known,
                                      const ControllerOptions& controller,
                                      const CommandedLog& commanded,
                                      const Eigen::VectorXd& times,
                                      unsigned seed);

}  // namespace armcal
