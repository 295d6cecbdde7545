#pragma once

#include <Eigen/Core>
#include <string>

#include "model/dynamics/joint_controller.h"
#include "model/robot/robot.h"

namespace armcal {

constexpr double kFastestHz = 20000;  // that a controller is simulated at

// Reads a controller in YAML, each key optional:
//
//   law: pd                       # or p, cascade (DriveKind)
//   rate: 1000                    # Hz, 1 to kFastestHz
//   bandwidth: 8                  # Hz; gains as DefaultController sets them
//   kp: [4000, ..]                # and all DriveParameters that the law has,
//                                 # per joint
//   delay: 0.004                  # of the command, s
//   velocity_filter: 100          # Hz
//   feedforward: inverse_dynamics # or none, gravity
//
// Throws InputError.
ControllerOptions ReadController(const std::string& path, const Robot& robot,
                                 const Eigen::VectorXd& q);

}  // namespace armcal
