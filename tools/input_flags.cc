#include "tools/input_flags.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>

#include "model/input_text.h"
#include "model/robot_reader.h"
#include "tools/command.h"

DEFINE_string(robot, "", "robot file: .urdf, or .yaml with a DH table");
DEFINE_string(base, "", "URDF link the arm starts at; default: the root");
DEFINE_string(tip, "", "URDF link the arm ends at; default: the only one");
DEFINE_string(gravity, "",
              "gravity vector in the base frame, m/s^2, such as 0,0,-9.81; "
              "default: the robot file's, for URDF 0,0,-9.81");
DEFINE_string(
    log, "", "logs to calibrate on or to verify with, CSV or CSV.gz: A[,B...]");
DEFINE_string(validate, "", "logs held out to check the result: C[,D...]");
DEFINE_string(torque_constants, "",
              "per joint, N m/A: torque = constant x gear ratio x current");
DEFINE_string(gear_ratios, "", "per joint; default: 1");
DEFINE_string(torque_kind, "auto",
              "what the log's torque is: auto, link, motor (motor side, times "
              "gear ratio), current, command");
DEFINE_string(bandwidth, "",
              "cutoff of the zero-phase low pass, Hz; 0: data as they are; "
              "default: 10 times the motion's frequency, 8 to 20 Hz");
DEFINE_string(crop, "",
              "use only t0:t1 of --log, s since its first row; default: all "
              "(standstill is left out by itself)");
DEFINE_string(validate_crop, "",
              "use only t0:t1 of the logs held out; default: all");
DEFINE_string(loss, "auto",
              "what large residuals count: auto (huber for torques, tukey for "
              "poses), huber, cauchy, tukey, squared (all alike, and no gross "
              "error is taken out of the torque)");
DEFINE_string(out, "", "folder for the result files; default: write none");

namespace armcal {
namespace {

std::vector<std::string> FileNames(const std::string& flag,
                                   const std::string& value) {
  std::vector<std::string> names = SplitAtCommas(value);
  for (const std::string& name : names) {
    if (!name.empty()) continue;
    throw UsageError("--" + flag + ": found '" + value +
                     "', expected file names with commas between them");
  }
  return names;
}

double ParseOne(const std::string& flag, const std::string& text) {
  const std::optional<double> number = ParseNumber(text);
  if (!number || !std::isfinite(*number)) {
    throw UsageError("--" + flag + ": found '" + text + "', expected a number");
  }
  return *number;
}

}  // namespace

const std::vector<std::string>& InputFlagNames() {
  static const std::vector<std::string> kNames = {
      "robot",      "log",     "validate",      "out",
      "bandwidth",  "crop",    "validate_crop", "base",
      "tip",        "gravity", "torque_kind",   "torque_constants",
      "gear_ratios"};
  return kNames;
}

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  size_t begin = 0;
  while (begin <= text.size() && !text.empty()) {
    const size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::vector<double> ParseNumbers(const std::string& flag,
                                 const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : SplitAtCommas(text)) {
    numbers.push_back(ParseOne(flag, part));
  }
  return numbers;
}

double PositiveNumber(const std::string& flag, const std::string& text) {
  const auto numbers = ParseNumbers(flag, text);
  if (numbers.size() != 1 || numbers[0] <= 0) {
    throw UsageError("--" + flag + ": found '" + text +
                     "', expected one positive number");
  }
  return numbers[0];
}

std::vector<TimeRange> ParseRanges(const std::string& flag,
                                   const std::string& text) {
  std::vector<TimeRange> ranges;
  for (const std::string& part : SplitAtCommas(text)) {
    const size_t colon = part.find(':');
    if (colon == std::string::npos) {
      throw UsageError("--" + flag + ": found '" + part +
                       "', expected t0:t1 in s");
    }
    TimeRange range;
    if (colon > 0) range.begin = ParseOne(flag, part.substr(0, colon));
    if (colon + 1 < part.size()) {
      range.end = ParseOne(flag, part.substr(colon + 1));
    }
    if (!(range.begin < range.end)) {
      throw UsageError("--" + flag + ": found '" + part +
                       "', expected t0 before t1");
    }
    ranges.push_back(range);
  }
  return ranges;
}

std::vector<const Effect*> ParseEffects(const std::string& flag,
                                        const std::string& text) {
  std::vector<const Effect*> effects;
  for (const std::string& name : SplitAtCommas(text)) {
    effects.push_back(FindEffect(name));
    if (effects.back() != nullptr) continue;
    std::string all;
    for (const Effect& effect : Effects()) all += " " + effect.name;
    throw UsageError("--" + flag + ": found '" + name + "', expected some of" +
                     all);
  }
  return effects;
}

void RefuseChoice(const std::string& flag, const std::string& value,
                  const std::vector<std::string>& choices) {
  throw UsageError("--" + flag + ": found '" + value + "', expected one of " +
                   JoinNames(choices));
}

Robot RobotFromFlags() {
  if (FLAGS_robot.empty()) throw UsageError("--robot=FILE is needed");
  RobotReaderOptions options;
  options.base = FLAGS_base;
  options.tip = FLAGS_tip;
  if (!FLAGS_gravity.empty()) {
    const std::vector<double> g = ParseNumbers("gravity", FLAGS_gravity);
    if (g.size() != 3) {
      throw UsageError("--gravity: found '" + FLAGS_gravity +
                       "', expected three numbers, x,y,z in m/s^2");
    }
    options.gravity = Eigen::Vector3d(g[0], g[1], g[2]);
  }
  return ReadRobot(FLAGS_robot, options);
}

LogReaderOptions LogOptionsFromFlags(const Robot& robot) {
  LogReaderOptions options;
  options.joint_names = robot.JointNames();
  options.torque_kind =
      ParseChoice<TorqueKind>("torque_kind", FLAGS_torque_kind,
                              {{"auto", TorqueKind::kAuto},
                               {"link", TorqueKind::kLink},
                               {"motor", TorqueKind::kMotor},
                               {"current", TorqueKind::kCurrent},
                               {"command", TorqueKind::kCommand}});
  options.torque_constants =
      ParseNumbers("torque_constants", FLAGS_torque_constants);
  options.gear_ratios = ParseNumbers("gear_ratios", FLAGS_gear_ratios);
  return options;
}

std::string RobotPathFromFlags() { return FLAGS_robot; }

std::vector<std::string> LogsFromFlags() {
  if (FLAGS_log.empty()) throw UsageError("--log=FILE is needed");
  return FileNames("log", FLAGS_log);
}

std::vector<std::string> ValidationLogsFromFlags() {
  return FileNames("validate", FLAGS_validate);
}

namespace {

TimeRange OneRange(const std::string& flag, const std::string& text) {
  const std::vector<TimeRange> ranges = ParseRanges(flag, text);
  if (ranges.size() > 1) {
    throw UsageError("--" + flag + " takes one range, t0:t1");
  }
  return ranges.empty() ? TimeRange() : ranges[0];
}

void RefuseTwice(const std::string& flag, std::vector<std::string> logs) {
  std::sort(logs.begin(), logs.end());
  const auto twice = std::adjacent_find(logs.begin(), logs.end());
  if (twice == logs.end()) return;
  throw UsageError("--" + flag + " names " + *twice +
                   " twice, which would count its evidence twice");
}

}  // namespace

TimeRange CropFromFlags() { return OneRange("crop", FLAGS_crop); }
TimeRange ValidationCropFromFlags() {
  return OneRange("validate_crop", FLAGS_validate_crop);
}

void CheckLogsApart() {
  const std::vector<std::string> logs = LogsFromFlags();
  RefuseTwice("log", logs);
  RefuseTwice("validate", ValidationLogsFromFlags());
  if (!FLAGS_crop.empty() && !FLAGS_validate_crop.empty()) return;
  for (const std::string& log : ValidationLogsFromFlags()) {
    if (std::count(logs.begin(), logs.end(), log) == 0) continue;
    throw UsageError("--validate names " + log +
                     ", which --log calibrates on; give --crop and "
                     "--validate_crop to use a part of it for each");
  }
}

std::optional<double> BandwidthFromFlags() {
  if (FLAGS_bandwidth.empty()) return std::nullopt;
  const double hz = ParseOne("bandwidth", FLAGS_bandwidth);
  if (hz < 0) {
    throw UsageError("--bandwidth: found '" + FLAGS_bandwidth +
                     "', expected a frequency in Hz, or 0");
  }
  return hz;
}

std::optional<RobustLoss> LossFromFlags() {
  return ParseChoice<std::optional<RobustLoss>>(
      "loss", FLAGS_loss,
      {{"auto", std::nullopt},
       {"huber", RobustLoss::kHuber},
       {"cauchy", RobustLoss::kCauchy},
       {"tukey", RobustLoss::kTukey},
       {"squared", RobustLoss::kSquared}});
}

std::string OutFromFlags() { return FLAGS_out; }
std::string BaseFromFlags() { return FLAGS_base; }

}  // namespace armcal
