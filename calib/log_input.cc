#include "calib/log_input.h"

#include <algorithm>
#include <cmath>

#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

bool IsCropped(const TimeRange& range) {
  return std::isfinite(range.begin) || std::isfinite(range.end);
}

void RefuseTwice(const std::string& option, std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice == names.end()) return;
  throw OptionError(OptionName(option) + " names " + *twice +
                    " twice, which would count its evidence twice");
}

}  // namespace

std::vector<std::string> NamesOf(const std::vector<LogSource>& logs) {
  std::vector<std::string> names;
  for (const LogSource& log : logs) names.push_back(log.name);
  return names;
}

void CheckApart(const LogInput& logs, const LogInput& validation) {
  const std::vector<std::string> names = NamesOf(logs.logs);
  const std::vector<std::string> held_out = NamesOf(validation.logs);
  if (names.empty()) throw OptionError(OptionName("log") + "=FILE is needed");
  RefuseTwice("log", names);
  RefuseTwice("validate", held_out);
  if (IsCropped(logs.crop) && IsCropped(validation.crop)) return;
  for (const std::string& log : held_out) {
    if (std::count(names.begin(), names.end(), log) == 0) continue;
    throw OptionError(OptionName("validate") + " names " + log + ", which " +
                      OptionName("log") + " calibrates on; give " +
                      OptionName("crop") + " and " +
                      OptionName("validate_crop") +
                      " to use a part of it for each");
  }
}

std::string NamedBefore(const LogInput& logs, const LogInput& validation,
                        const std::vector<LogSource>& more) {
  std::vector<std::string> all = NamesOf(logs.logs);
  for (const std::string& name : NamesOf(validation.logs)) all.push_back(name);
  for (const LogSource& log : more) {
    if (std::count(all.begin(), all.end(), log.name) > 0) return log.name;
    all.push_back(log.name);
  }
  return "";
}

}  // namespace armcal
