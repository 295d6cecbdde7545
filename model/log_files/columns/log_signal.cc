#include "model/log_files/columns/log_signal.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

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

// Columns that are numbered from 0 between two texts.
struct RecordedColumns {
  Signal signal;
  std::string_view before, after;
};

// Recognised by its column of time and the first of its positions.
struct Recorder {
  std::string_view time, own_time;
  std::vector<RecordedColumns> columns;  // positions first
};

const std::vector<Recorder>& Recorders() {
  static const auto* const recorders = new std::vector<Recorder>{
      // Universal Robots' RTDE, by record.py of their Python client
      // (csv_writer.py): fields as in the RTDE guide, vectors numbered.
      {"timestamp",
       "timestamp",
       {{Signal::kPosition, "actual_q_", ""},
        {Signal::kVelocity, "actual_qd_", ""},
        {Signal::kCurrent, "actual_current_", ""},
        {Signal::kEffort, "actual_current_as_torque_", ""},
        {Signal::kReference, "target_q_", ""},
        {Signal::kTemperature, "joint_temperatures_", ""}}},
      // logToCSV of libfranka since 2024 (robot_state_log.cpp), which counts
      // time in ms.
      {"time",
       "time [ms]",
       {{Signal::kPosition, "state.q[", "]"},
        {Signal::kVelocity, "state.dq[", "]"},
        {Signal::kEffort, "state.tau_J[", "]"},
        {Signal::kReference, "state.q_d[", "]"}}},
      // The same before (log.cpp).
      {"duration",
       "t [ms]",
       {{Signal::kPosition, "q[", "]"},
        {Signal::kVelocity, "dq[", "]"},
        {Signal::kEffort, "tau_J[", "]"},
        {Signal::kReference, "q_d[", "]"}}},
  };
  return *recorders;
}

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const Recorder* FindRecorder(const std::vector<std::string>& names) {
  for (const Recorder& recorder : Recorders()) {
    const RecordedColumns& positions = recorder.columns[0];
    if (Has(names, std::string(recorder.time)) &&
        Has(names, std::string(positions.before) + "0" +
                       std::string(positions.after))) {
      return &recorder;
    }
  }
  return nullptr;
}

std::string OwnName(const Recorder& recorder, const std::string& name) {
  if (name == recorder.time) return std::string(recorder.own_time);
  for (const RecordedColumns& columns : recorder.columns) {
    const int number = NumberBetween(columns.before, columns.after, name);
    if (number < 0) continue;
    return std::string(NamesOf(columns.signal).number_prefix) +
           std::to_string(number + 1);
  }
  return name;
}

}  // namespace

int NumberBetween(std::string_view before, std::string_view after,
                  std::string_view name) {
  const size_t around = before.size() + after.size();
  if (name.size() <= around || name.substr(0, before.size()) != before ||
      name.substr(name.size() - after.size()) != after) {
    return -1;
  }
  const std::string_view digits =
      name.substr(before.size(), name.size() - around);
  int number = -1;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  return error == std::errc() && stop == end ? number : -1;
}

std::vector<std::string> OwnNames(std::vector<std::string> names) {
  const Recorder* recorder = FindRecorder(names);
  if (recorder == nullptr) return names;
  std::set<std::string> taken(names.begin(), names.end());
  for (std::string& name : names) {
    const std::string own = OwnName(*recorder, name);
    if (taken.insert(own).second) name = own;
  }
  return names;
}

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
      {"u", "voltage", {{"V", 1}, {"mV", 1e-3}}},
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
