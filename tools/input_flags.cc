#include "tools/input_flags.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>

#include "model/log_files/columns/wrench_columns.h"
#include "model/robot_files/robot_reader.h"
#include "model/text/input_text.h"
#include "tools/command.h"
#include "tools/flag_choices.h"

DEFINE_string(robot, "", "`FILE` robot: URDF, MJCF, SDF or YAML");
DEFINE_string(base, "",
              "`LINK` (body) that the arm starts at; default: the root");
DEFINE_string(tip, "",
              "`LINK` that the arm ends at, or links, as in "
              "left_hand,right_hand; default: the only one");
DEFINE_string(posture, "",
              "`JOINT=Q,..` where other joints are held, such as a gripper's, "
              "rad or m; default: next to 0");
DEFINE_string(gravity, "",
              "`X,Y,Z` gravity in the base frame, m/s^2; "
              "default: the robot file's, for URDF 0,0,-9.81");
DEFINE_string(robot_folder, "",
              "`DIR` that files which the robot's MJCF names may lie in; "
              "default: its own folder");
DEFINE_string(log, "", "`FILES` logs A[,B..]: CSV, ROS 2 bags, .npz, .mat");
DEFINE_string(validate, "", "`FILES` logs held out to check the result");
DEFINE_string(torque_constants, "",
              "`K1,K2..` per joint, N m/A: torque = constant x gear ratio x "
              "current; N m/V of voltages");
DEFINE_string(torque_constants_stddev, "",
              "`SHARE` of each joint's torque by which its scale may be off, a "
              "standard deviation; default: .05 for currents, .1 for voltages, "
              ".02 for torques, 0 for logs of armcal simulate");
DEFINE_string(gear_ratios, "", "`N1,N2..` per joint; default: 1");
DEFINE_string(torque_kind, "auto",
              "what the log's torque is: auto, link, motor (motor side, times "
              "gear ratio), current, command, voltage");
DEFINE_string(topics, "",
              "`A,SIGNAL:B..` topics of ROS 2 bags, as in "
              "/joint_states,effort:/torques,wrench:/ft");
DEFINE_string(bandwidth, "",
              "`HZ` cutoff of the low pass; 0: data as they are; default: 10 "
              "times the motion's frequency, 8 to 20 Hz (watch: 20)");
DEFINE_string(crop, "",
              "`T0:T1` of --log to use, s since its first row; default: all "
              "(standstill is left out by itself)");
DEFINE_string(validate_crop, "",
              "`T0:T1` of the logs held out to use; default: all");
DEFINE_string(loss, "auto",
              "what large residuals count: auto (huber for torques, tukey for "
              "poses), huber, cauchy, tukey, squared (all alike, and no gross "
              "error is taken out of the torque)");
DEFINE_int32(threads, 0,
             "`N` that share the work; default: one per core. Results are the "
             "same for any number");
DEFINE_string(out, "",
              "`DIR` for the result files; default: none (simulate: needed)");

namespace armcal {
namespace {

const FlagChoices<TorqueKind> kTorqueKinds("torque_kind",
                                           {{"auto", TorqueKind::kAuto},
                                            {"link", TorqueKind::kLink},
                                            {"motor", TorqueKind::kMotor},
                                            {"current", TorqueKind::kCurrent},
                                            {"command", TorqueKind::kCommand},
                                            {"voltage", TorqueKind::kVoltage}});
const FlagChoices<std::optional<RobustLoss>> kLosses(
    "loss", {{"auto", std::nullopt},
             {LossName(RobustLoss::kHuber), RobustLoss::kHuber},
             {LossName(RobustLoss::kCauchy), RobustLoss::kCauchy},
             {LossName(RobustLoss::kTukey), RobustLoss::kTukey},
             {LossName(RobustLoss::kSquared), RobustLoss::kSquared}});

std::vector<std::string> EffectNames() {
  std::vector<std::string> names;
  for (const Effect& effect : Effects()) names.push_back(effect.name);
  return names;
}

FlagWords EffectWords() { return {EffectNames(), true}; }
const FlagWordsAdded kSeparated("separate", &EffectWords);
const FlagWordsAdded kLeftOut("without", &EffectWords);

// "/joint_states", "effort:/torques" or "wrench:/ft".
LogTopic ParseTopic(const std::string& text) {
  const size_t colon = text.find(':');
  if (colon == std::string::npos && !text.empty()) return {text, std::nullopt};
  const bool named = colon + 1 < text.size();
  const std::string what = text.substr(0, colon);
  std::vector<std::string> signals;
  for (const Signal signal : kSignals) {
    signals.emplace_back(NamesOf(signal).path_part);
    if (named && what == signals.back())
      return {text.substr(colon + 1), signal};
  }
  signals.emplace_back(kWrenchArray);
  if (named && what == kWrenchArray) {
    return {text.substr(colon + 1), std::nullopt, true};
  }
  throw UsageError("--topics: found '" + text +
                   "', expected a topic's name, or one of " +
                   JoinNames(signals) + " and a colon before it");
}

double ParseOne(const std::string& flag, const std::string& text) {
  const std::optional<double> number = ParseNumber(text);
  if (!number || !std::isfinite(*number)) {
    throw UsageError("--" + flag + ": found '" + text + "', expected a number");
  }
  return *number;
}

// From 0 up to 1; nothing where the flag is not given.
std::optional<double> ShareOrNothing(const std::string& flag,
                                     const std::string& text) {
  if (text.empty()) return std::nullopt;
  const double share = ParseOne(flag, text);
  if (share >= 0 && share < 1) return share;
  throw UsageError("--" + flag + ": found '" + text +
                   "', expected a share from 0 to below 1, as in 0.03");
}

}  // namespace

FlagGroup TorqueFlags() {
  return {"torques of logs",
          {"torque_kind", "torque_constants", "torque_constants_stddev",
           "gear_ratios", "topics"},
          false};
}

FlagGroup ChainFlags() {
  return {"chain of the robot",
          {"base", "tip", "posture", "gravity", "robot_folder"},
          false};
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
    RefuseChoice(flag, name, EffectNames());
  }
  return effects;
}

namespace {

std::map<std::string, double> ParsePosture(const std::string& text) {
  std::map<std::string, double> posture;
  for (const std::string& part : SplitAtCommas(text)) {
    const size_t equals = part.rfind('=');
    if (equals == std::string::npos || equals == 0) {
      throw UsageError("--posture: found '" + part +
                       "', expected joint=position, as in finger_joint1=0.02");
    }
    posture[part.substr(0, equals)] =
        ParseOne("posture", part.substr(equals + 1));
  }
  return posture;
}

}  // namespace

Robot RobotFromFlags(const CommandInput& input) {
  if (input.robot) return *input.robot;
  const std::string path = input.flags.Text("robot");
  if (path.empty()) throw UsageError("--robot=FILE is needed");
  return RobotOfFile(path, input.flags);
}

Robot RobotOfFile(const std::string& path, const FlagValues& flags) {
  RobotReaderOptions options;
  options.base = flags.Text("base");
  options.tip = flags.Text("tip");
  options.posture = ParsePosture(flags.Text("posture"));
  options.folder = flags.Text("robot_folder");
  if (!flags.Text("gravity").empty()) {
    const std::vector<double> g =
        ParseNumbers("gravity", flags.Text("gravity"));
    if (g.size() != 3) {
      throw UsageError("--gravity: found '" + flags.Text("gravity") +
                       "', expected three numbers, x,y,z in m/s^2");
    }
    options.gravity = Eigen::Vector3d(g[0], g[1], g[2]);
  }
  return ReadRobot(path, options);
}

LogReaderOptions LogOptionsFromFlags(const FlagValues& flags,
                                     const Robot& robot) {
  LogReaderOptions options;
  options.joint_names = robot.JointNames();
  options.torque_kind = kTorqueKinds.Parse(flags.Text("torque_kind"));
  options.torque_constants =
      ParseNumbers("torque_constants", flags.Text("torque_constants"));
  options.torque_constants_stddev = ShareOrNothing(
      "torque_constants_stddev", flags.Text("torque_constants_stddev"));
  options.gear_ratios = ParseNumbers("gear_ratios", flags.Text("gear_ratios"));
  const std::vector<std::string> topics = SplitAtCommas(flags.Text("topics"));
  for (size_t k = 0; k < topics.size(); ++k) {
    if (std::count(topics.begin(), topics.begin() + k, topics[k]) > 0) {
      throw UsageError("--topics: names '" + topics[k] + "' twice");
    }
    options.topics.push_back(ParseTopic(topics[k]));
  }
  return options;
}

Document RobotFileFromFlags(const CommandInput& input) {
  if (input.robot_file) return *input.robot_file;
  return {input.flags.Text("robot")};
}

namespace {

// A shell does not fill in --log=*.csv, as no file is called "--log=..".
void RefusePattern(const std::string& flag, const std::string& name) {
  std::error_code error;
  if (name.find_first_of("*?") == std::string::npos ||
      std::filesystem::exists(name, error)) {
    return;
  }
  throw UsageError("--" + flag + ": found '" + name +
                   "', expected file names with commas between them: "
                   "--" +
                   flag + "=$(ls " + name + " | paste -sd,)");
}

}  // namespace

std::vector<std::string> FileNames(const std::string& flag,
                                   const std::string& value) {
  std::vector<std::string> names = SplitAtCommas(value);
  for (const std::string& name : names) {
    if (name.empty()) {
      throw UsageError("--" + flag + ": found '" + value +
                       "', expected file names with commas between them");
    }
    RefusePattern(flag, name);
  }
  return names;
}

std::vector<std::string> LogsFromFlags(const CommandInput& input) {
  const std::string logs = input.flags.Text("log");
  if (logs.empty()) throw UsageError("--log=FILE is needed");
  return FileNames("log", logs);
}

std::vector<std::string> ValidationLogsFromFlags(const CommandInput& input) {
  return FileNames("validate", input.flags.Text("validate"));
}

namespace {

TimeRange OneRange(const std::string& flag, const std::string& text) {
  const std::vector<TimeRange> ranges = ParseRanges(flag, text);
  if (ranges.size() > 1) {
    throw UsageError("--" + flag + " takes one range, t0:t1");
  }
  return ranges.empty() ? TimeRange() : ranges[0];
}

}  // namespace

TimeRange CropFromFlags(const FlagValues& flags) {
  return OneRange("crop", flags.Text("crop"));
}
TimeRange ValidationCropFromFlags(const FlagValues& flags) {
  return OneRange("validate_crop", flags.Text("validate_crop"));
}

std::optional<double> BandwidthFromFlags(const FlagValues& flags) {
  if (flags.Text("bandwidth").empty()) return std::nullopt;
  const double hz = ParseOne("bandwidth", flags.Text("bandwidth"));
  if (hz < 0) {
    throw UsageError("--bandwidth: found '" + flags.Text("bandwidth") +
                     "', expected a frequency in Hz, or 0");
  }
  return hz;
}

std::optional<RobustLoss> LossFromFlags(const FlagValues& flags) {
  return kLosses.Parse(flags.Text("loss"));
}

int ThreadsFromFlags(const FlagValues& flags) {
  const int threads = flags.Whole("threads");
  if (threads >= 0) return threads;
  throw UsageError("--threads: found '" + std::to_string(threads) +
                   "', expected a number of threads, or 0 for all cores");
}

std::string OutFromFlags(const FlagValues& flags) { return flags.Text("out"); }
std::string BaseFromFlags(const FlagValues& flags) {
  return flags.Text("base");
}

}  // namespace armcal
