#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/summary.h"
#include "model/robot/robot.h"

namespace armcal {

struct CalibrationDetails;  // calib/calibration_details.h

struct EstimatedParameter {
  std::string name;
  std::string unit;
  double value;
  double stddev;  // infinite where the data do not tell it
};

struct CalibrateSummary : Summary {
  bool solved = false;
  // Of the robot for simulators where it was refined, else of the model; their
  // covariance has rows of zeros where the data do not tell.
  std::vector<EstimatedParameter> parameters;
  Eigen::MatrixXd covariance;
  std::optional<Robot> robot;  // calibrated, for simulators
  std::shared_ptr<const CalibrationDetails> details;
};

}  // namespace armcal
