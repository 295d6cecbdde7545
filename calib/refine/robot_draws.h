#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/refine/nonlinear_calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// Robots that a calibration allows for, each as likely as the other.
struct RobotDraws {
  std::vector<std::string> names;  // of parameters, those that are held too
  Eigen::MatrixXd values;          // a column per robot
  std::vector<Robot> robots;
};

// Draws robots from the posterior of a calibration, the Gaussian of
// parameters_posterior.csv, as far as they can exist: every link's
// pseudo-inertia is positive definite, masses, friction and armature are not
// negative. This set is convex, and on a line its ends are known: those of a
// link are 1 / eigenvalues of its change relative to itself. Parameters that
// are not the robot's (of the instrument, of drives) are drawn along with the
// others and change no robot. `count` robots, the same for the same result.
RobotDraws DrawRobots(const NonlinearCalibration& calibrated, int count);

// A header of the parameters' names, a row per robot; SI units.
std::string RobotDrawsCsv(const RobotDraws& draws);

}  // namespace armcal
