#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/excite/posture_design.h"
#include "model/robot/robot.h"

namespace armcal {

struct PostureSummary {
  const Robot& robot;
  const PostureOptions& options;
  const PostureDesign& design;
  std::vector<std::string> assumed;
};

std::string FullReport(const PostureSummary& summary);
nlohmann::json ToJson(const PostureSummary& summary);
// As CSV: q1..qn, rad or m.
std::string PostureText(const PostureDesign& design);

}  // namespace armcal
