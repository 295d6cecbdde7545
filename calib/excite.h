#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/excite_options.h"
#include "calib/summary.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

struct ExciteSummary : Summary {
  Log motion;             // one to follow, all its periods; empty: none, or
  Eigen::MatrixXd poses;  // postures x joints, rad or m
  std::vector<std::string> assumed;  // sentences: what nobody said
};

// The motion, or the postures, that tell most about a robot within its limits,
// and how well they will tell. It is positive where there is one. Throws
// InputError and OptionError.
ExciteSummary Excite(const Robot& robot, const ExciteOptions& options);

}  // namespace armcal
