#include "calib/fleet/combine.h"

#include <algorithm>
#include <tuple>

#include "calib/fleet/reduction_json.h"
#include "model/text/input_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using nlohmann::json;

// Where the models differ, or both agree in everything.
void ExpectSameModel(const std::string& file, const json& found,
                     const std::string& first, const json& expected) {
  for (const auto& [key, value] : expected.items()) {
    if (found.at(key) == value) continue;
    if (key == "robot" || key == "robot_sha256") {
      throw InputError(file, "key model." + key, found.at(key).dump(),
                       "expected " + value.dump() + ", the robot file of " +
                           first + "; reduce both with one robot file");
    }
    throw InputError(file, "key model." + key, found.at(key).dump(),
                     "expected " + value.dump() + " as in " + first +
                         "; reduce the log with " + OptionName("like") + "=" +
                         first);
  }
}

// By which logs are put in order; no two may have the same.
auto Key(const ReducedLog& log) {
  return std::tie(log.sha256, log.range.begin);
}

}  // namespace

Reduction Combine(const std::vector<std::pair<std::string, Reduction>>& parts) {
  struct Named {
    const std::string* file;
    const ReducedLog* log;
  };
  std::vector<Named> logs;
  const json model = ToJson(parts.at(0).second.model);
  for (const auto& [file, part] : parts) {
    ExpectSameModel(file, ToJson(part.model), parts[0].first, model);
    for (const ReducedLog& log : part.logs) logs.push_back({&file, &log});
  }
  std::sort(logs.begin(), logs.end(), [](const Named& a, const Named& b) {
    return Key(*a.log) < Key(*b.log);
  });
  Reduction all{parts[0].second.model, {}};
  for (size_t k = 0; k < logs.size(); ++k) {
    const ReducedLog& log = *logs[k].log;
    if (k > 0 && logs[k - 1].log->sha256 == log.sha256 &&
        log.range.begin < logs[k - 1].log->range.end) {
      throw InputError(*logs[k].file, "log " + log.file, "",
                       "its bytes are in " + *logs[k - 1].file +
                           " already; merged with it, its evidence would "
                           "count twice");
    }
    all.logs.push_back(log);
  }
  return all;
}

}  // namespace armcal
