#include "model/log_files/columns/wrench_columns.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "model/log_files/columns/column_words.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

constexpr int kForces = 3;  // the first of the six

constexpr Unit kForceUnits[] = {{"N", 1}, {"mN", 1e-3}, {"kN", 1e3}};

double WrenchScale(const std::string& file, const std::string& column,
                   std::string_view unit, bool is_force) {
  if (unit.empty()) return 1;
  const Unit* found = nullptr;
  if (is_force) {
    const Unit* const end = std::end(kForceUnits);
    found = std::find_if(std::begin(kForceUnits), end,
                         [&](const Unit& u) { return u.name == unit; });
    if (found == end) found = nullptr;
  } else if (unit != "N") {
    found = FindUnit(Signal::kEffort, unit);
  }
  if (found != nullptr) return found->scale;
  throw InputError(file, "row 1, column " + column, std::string(unit),
                   is_force ? "expected the unit N, mN or kN"
                            : "expected the unit Nm, mNm or kNm");
}

// Which of the six a name means, -1 for none, and what stands before: nothing
// for fx to tz, the other words of a name that spells them out.
int WhichOfSix(std::string_view name, std::string* before) {
  for (int k = 0; k < kWrenchColumns; ++k) {
    if (name == kWrenchNames[k]) return *before = "", k;
  }
  const std::vector<std::string> words = ColumnWords(name);
  const size_t size = words.size();
  if (size < 2) return -1;
  const std::string &quantity = words[size - 2], &axis = words[size - 1];
  const bool is_force = quantity == "force";
  if ((!is_force && quantity != "torque") || axis.size() != 1 ||
      axis[0] < 'x' || axis[0] > 'z') {
    return -1;
  }
  // A force of something else has another name than a wrench before it.
  static const std::set<std::string>* const kSensors =
      new std::set<std::string>{"wrench", "ft", "sensor"};
  if (size > 2 && kSensors->count(words[size - 3]) == 0) return -1;
  *before = " ";
  for (size_t w = 0; w + 2 < size; ++w) *before += words[w] + " ";
  return axis[0] - 'x' + (is_force ? 0 : kForces);
}

using Six = std::array<std::vector<int>, kWrenchColumns>;  // indices

// The six names as they would be spelled after what stands before them.
std::string NameOfSix(const std::string& before, int k) {
  if (before.empty()) return kWrenchNames[k];
  const std::string words = before + (k < kForces ? "force" : "torque");
  std::string name(Trim(words));
  std::replace(name.begin(), name.end(), ' ', '_');
  return name + "_" + "xyz"[k % kForces];
}

std::vector<LogColumn> Complete(const std::string& file,
                                const LogColumns& columns,
                                const std::string& before, const Six& six) {
  std::vector<LogColumn> found;
  std::string missing, there;
  for (int k = 0; k < kWrenchColumns; ++k) {
    const std::string name = NameOfSix(before, k);
    if (six[k].size() > 1) {
      throw InputError(file, "row 1", name, "the column is there twice");
    }
    std::string* const list = six[k].empty() ? &missing : &there;
    *list += (list->empty() ? "" : ", ") + name;
    if (six[k].empty()) continue;
    const int index = six[k][0];
    std::string_view unit;
    SplitUnit(columns.name(index), &unit);
    found.push_back(
        {index, WrenchScale(file, columns.name(index), unit, k < kForces)});
  }
  if (missing.empty()) return found;
  throw InputError(file, "row 1", there,
                   "a force-torque sensor has six columns, of which " +
                       missing + " is missing");
}

}  // namespace

std::vector<LogColumn> FindWrench(const std::string& file,
                                  const LogColumns& columns) {
  std::map<std::string, Six> sensors;  // by what stands before the names
  for (int k = 0; k < columns.size(); ++k) {
    std::string_view unit;
    const std::string_view name = SplitUnit(columns.name(k), &unit);
    std::string before;
    const int which = WhichOfSix(name, &before);
    if (which >= 0) sensors[before][which].push_back(k);
  }
  for (auto at = sensors.begin(); at != sensors.end();) {
    const bool has_force =
        std::any_of(at->second.begin(), at->second.begin() + kForces,
                    [](const auto& found) { return !found.empty(); });
    at = has_force ? std::next(at) : sensors.erase(at);
  }
  if (sensors.empty()) return {};
  if (sensors.size() > 1) {
    throw InputError(file, "row 1",
                     NameOfSix(sensors.begin()->first, 0) + " and " +
                         NameOfSix(std::next(sensors.begin())->first, 0),
                     "expected one force-torque sensor; rename the other's "
                     "columns");
  }
  return Complete(file, columns, sensors.begin()->first,
                  sensors.begin()->second);
}

}  // namespace armcal
