#include "model/log_files/log_signal.h"

#include <algorithm>
#include <cmath>

#include "model/text/input_text.h"

namespace armcal {
namespace {

struct TimeUnit {
  std::string_view name;
  int decimals;
};

constexpr std::string_view kTimeNames[] = {"t", "time", "timestamp", "__time"};

constexpr TimeUnit kTimeUnits[] = {{"", 0},   {"s", 0},       {"ms", 3},
                                   {"us", 6}, {"\u00b5s", 6}, {"ns", 9}};

}  // namespace

const SignalNames& NamesOf(Signal signal) {
  constexpr double kDegree = M_PI / 180;
  static const auto* const names = new std::vector<SignalNames>{
      {"q", "position", {{"rad", 1}, {"deg", kDegree}, {"m", 1}, {"mm", 1e-3}}},
      {"qd",
       "velocity",
       {{"rad/s", 1}, {"deg/s", kDegree}, {"m/s", 1}, {"mm/s", 1e-3}}},
      {"qdd",
       "acceleration",
       {{"rad/s^2", 1}, {"deg/s^2", kDegree}, {"m/s^2", 1}, {"mm/s^2", 1e-3}}},
      {"tau",
       "effort",
       {{"Nm", 1}, {"N m", 1}, {"N", 1}, {"mNm", 1e-3}, {"kNm", 1e3}}},
      {"i", "current", {{"A", 1}, {"mA", 1e-3}}},
      {"qref",
       "reference",
       {{"rad", 1}, {"deg", kDegree}, {"m", 1}, {"mm", 1e-3}}},
      {"temp", "temperature", {{"degC", 1}, {"deg C", 1}, {"C", 1}}},
  };
  return (*names)[static_cast<int>(signal)];
}

const Unit* FindUnit(Signal signal, std::string_view name) {
  for (const Unit& unit : NamesOf(signal).units) {
    if (unit.name == name) return &unit;
  }
  return nullptr;
}

bool IsTimeName(std::string_view name) {
  return std::count(std::begin(kTimeNames), std::end(kTimeNames), name) > 0;
}

bool FindTimeUnit(std::string_view name, int* decimals) {
  for (const TimeUnit& unit : kTimeUnits) {
    if (unit.name != name) continue;
    *decimals = unit.decimals;
    return true;
  }
  return false;
}

std::string_view SplitUnit(std::string_view name, std::string_view* unit) {
  *unit = {};
  const size_t open = name.rfind('[');
  if (name.empty() || name.back() != ']' || open == std::string_view::npos) {
    return name;
  }
  *unit = Trim(name.substr(open + 1, name.size() - open - 2));
  return Trim(name.substr(0, open));
}

}  // namespace armcal
