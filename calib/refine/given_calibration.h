#pragma once

#include <Eigen/Core>
#include <string>

#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"

namespace armcal {

// What a calibration that was written knows.
struct GivenCalibration {
  Eigen::VectorXd density;  // ErrorDensity of its logs, one entry per joint
  Eigen::MatrixXd A;        // m x m, information on the model's parameters
};

// Reads the calibration.json of `armcal calibrate` and the covariance.csv
// beside it. Parameters are matched by name: of those that the calibration
// leaves open or does not have, nothing is known. Throws InputError where a
// file is not as written, is of another robot, or where a parameter that it
// knows is none of `model`.
GivenCalibration ReadGivenCalibration(const std::string& path,
                                      const Robot& robot,
                                      const ModelParameters& model);

}  // namespace armcal
