#include "calib/linear/outlier_report.h"

#include <cstdio>

#include "calib/numerics/json_figures.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// visit(log's path, outlier) for all of them, in order.
template <class Visit>
void ForEachOutlier(const LogSet& logs, const Visit& visit) {
  for (size_t log = 0; log < logs.outliers().size(); ++log) {
    for (const TorqueOutlier& o : logs.outliers()[log]) {
      visit(logs.path(static_cast<int>(log)), o);
    }
  }
}

}  // namespace

long CountOutliers(const LogSet& logs) {
  long count = 0;
  ForEachOutlier(logs, [&](const auto&, const auto&) { ++count; });
  return count;
}

long CountOutliers(const LogSet& logs, int joint) {
  long count = 0;
  ForEachOutlier(
      logs, [&](const auto&, const auto& o) { count += o.joint == joint; });
  return count;
}

std::string OutlierText(const Robot& robot, const LogSet& logs) {
  std::string text;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const long count = CountOutliers(logs, i);
    if (count == 0) continue;
    text += (text.empty() ? " " : ", ") + std::to_string(count) + " of " +
            robot.links[i].joint.name;
  }
  if (text.empty()) return "";
  return "outliers  " + text +
         ": torque samples beyond 8 noise deviations, left out of the fit; " +
         OptionName("out") + " lists them in outliers.csv\n";
}

nlohmann::json OutlierJson(const Robot& robot, const LogSet& logs, int most) {
  nlohmann::json list = nlohmann::json::array();
  ForEachOutlier(logs, [&](const std::string& path, const TorqueOutlier& o) {
    if (static_cast<int>(list.size()) >= most) return;
    list.push_back({{"log", path},
                    {"row", o.row},
                    {"time", o.time},
                    {"joint", robot.links[o.joint].joint.name},
                    {"value", JsonNumber(o.recorded)},
                    {"residual", JsonNumber(o.size)}});
  });
  return list;
}

std::string OutlierCsv(const Robot& robot, const LogSet& logs) {
  std::string text = "log,row,time,joint,value,residual\n";
  ForEachOutlier(logs, [&](const std::string& path, const TorqueOutlier& o) {
    char numbers[96];
    std::snprintf(numbers, sizeof(numbers), "\",%ld,%.9g,\"", o.row, o.time);
    text += "\"" + path + numbers + robot.links[o.joint].joint.name;
    std::snprintf(numbers, sizeof(numbers), "\",%.9g,%.4g\n", o.recorded,
                  o.size);
    text += numbers;
  });
  return text;
}

}  // namespace armcal
