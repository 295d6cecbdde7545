#include "calib/linear/outlier_report.h"

#include <cstdio>

#include "calib/numerics/json_figures.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// visit(log, outlier) for all of them, in order.
template <class Visit>
void ForEachOutlier(const LinearCalibration& result, const Visit& visit) {
  if (!result.preparation.outliers) return;
  int log = 0;
  for (const auto& list : *result.preparation.outliers) {
    for (const TorqueOutlier& outlier : list) visit(log, outlier);
    ++log;
  }
}

}  // namespace

long CountOutliers(const LinearCalibration& result) {
  long count = 0;
  ForEachOutlier(result, [&](int, const auto&) { ++count; });
  return count;
}

long CountOutliers(const LinearCalibration& result, int joint) {
  long count = 0;
  ForEachOutlier(result,
                 [&](int, const auto& o) { count += o.joint == joint; });
  return count;
}

std::string OutlierText(const Robot& robot, const LinearCalibration& result) {
  std::string text;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const long count = CountOutliers(result, i);
    if (count == 0) continue;
    text += (text.empty() ? " " : ", ") + std::to_string(count) + " of " +
            robot.links[i].joint.name;
  }
  if (text.empty()) return "";
  return "outliers  " + text +
         ": torque samples beyond 8 noise deviations, left out of the fit; " +
         OptionName("out") + " lists them in outliers.csv\n";
}

nlohmann::json OutlierJson(const Robot& robot, const LogSet& training,
                           const LinearCalibration& result, int most) {
  nlohmann::json list = nlohmann::json::array();
  ForEachOutlier(result, [&](int log, const TorqueOutlier& o) {
    if (static_cast<int>(list.size()) >= most) return;
    list.push_back({{"log", training.path(log)},
                    {"row", o.row},
                    {"time", o.time},
                    {"joint", robot.links[o.joint].joint.name},
                    {"value", JsonNumber(o.recorded)},
                    {"residual", JsonNumber(o.size)}});
  });
  return list;
}

// Names stand in quotes, since paths and joints may hold commas.
std::string OutlierCsv(const Robot& robot, const LogSet& training,
                       const LinearCalibration& result) {
  std::string text = "log,row,time,joint,value,residual\n";
  ForEachOutlier(result, [&](int log, const TorqueOutlier& o) {
    char numbers[96];
    std::snprintf(numbers, sizeof(numbers), "\",%ld,%.9g,\"", o.row, o.time);
    text +=
        "\"" + training.path(log) + numbers + robot.links[o.joint].joint.name;
    std::snprintf(numbers, sizeof(numbers), "\",%.9g,%.4g\n", o.recorded,
                  o.size);
    text += numbers;
  });
  return text;
}

}  // namespace armcal
