#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/dynamics/joint_term.h"
#include "model/robot/robot.h"

namespace armcal {

// What a refined calibration knows of a robot's links and joint terms together:
// the posterior of its logs and of the robot file as far as that was trusted,
// a Gaussian about the calibrated values.
struct ParameterPosterior {
  struct Parameter {
    int link;                       // or joint
    std::optional<JointTerm> term;  // none: an inertial parameter
    int inertial = 0;               // index in InertialParameters::ToVector()
  };
  std::vector<Parameter> parameters;  // that were estimated
  Eigen::MatrixXd covariance;         // of them, SI units

  // Of a joint's term; 0 where it was not estimated.
  double Stddev(int joint, JointTerm term) const;
};

// The calibration.json at `path`; of a folder that has one, that.
std::string CalibrationFile(const std::string& path);

// Reads the calibration.json that `armcal calibrate` wrote for `robot` and the
// parameters_posterior.csv beside it. What a calibration held at the robot
// file's value is not in it, nor are geometry and controllers, over which it is
// the marginal. Throws InputError as ReadCalibration does, and where the
// posterior is missing, is not as written or tells nothing.
ParameterPosterior ReadParameterPosterior(const std::string& path,
                                          const Robot& robot);

}  // namespace armcal
