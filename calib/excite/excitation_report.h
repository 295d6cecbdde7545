#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/excite/design_target.h"
#include "calib/excite/excitation.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

// A designed motion and what it was designed for.
struct ExcitationSummary {
  const Robot& robot;
  const ExcitationOptions& options;
  const NamedQuantities& quantities;
  const Excitation& excitation;
  Eigen::VectorXd given_stddev;  // before the motion, of all quantities
  std::vector<std::string> assumed;
  // Of effects that are told apart: were the others known. Empty: not asked.
  Eigen::VectorXd alone_stddev;
};

std::string FullReport(const ExcitationSummary& summary);
nlohmann::json ToJson(const ExcitationSummary& summary);

// The motion as a log of q, qd and qdd, all its periods and the sample after
// them, `rate_hz` samples a second.
Log MotionLog(const Excitation& excitation, int periods, double rate_hz);

}  // namespace armcal
