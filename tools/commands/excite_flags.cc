#include "tools/commands/excite_flags.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "model/text/input_text.h"
#include "tools/command.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"
#include "tools/simulation_flags.h"

DEFINE_string(target, "model",
              "what the motion is to tell: model (parameters), physical "
              "(inertias, friction), geometry (lengths)");
DEFINE_string(criterion, "D",
              "what is to be small: D (volume of the confidence ellipsoid), A "
              "(sum of variances), worst (largest standard deviation)");
DEFINE_string(
    separate, "",
    "`A,B[,..]` effects that the motion is to tell apart on every joint, "
    "instead of a --target");
DEFINE_int32(harmonics, 0,
             "of the base frequency, per joint; default: up to 0.5 Hz");
DEFINE_int32(periods, 1, "equal periods that the motion consists of");
DEFINE_string(
    position_limits, "",
    "`LOW:HIGH[,..]`, one or one per joint, rad or m; default: the file's");
DEFINE_string(
    velocity_limits, "",
    "`V[,..]` rad/s or m/s, one or one per joint; default: the file's");
DEFINE_string(
    acceleration_limits, "",
    "`A[,..]` rad/s^2 or m/s^2; default: 3 times the velocity in 1 s");
DEFINE_string(effort_limits, "", "`T[,..]` N m or N; default: the file's");
DEFINE_string(
    tool_box, "",
    "`BOX` x:x,y:y,z:z in the base's frame, m, that the tool's point stays "
    "in; default: anywhere");
DEFINE_string(floor, "", "`M` height over the base that links stay above");
DEFINE_string(obstacles, "",
              "`BOXES` that links stay out of: x:x,y:y,z:z[;x:x,y:y,z:z..], m");
DEFINE_double(link_radius, .06, "of the links, for --floor and --obstacles, m");
DEFINE_double(use, .95, "share of the limits that the motion may use");
DEFINE_int32(static_poses, 0, "`N` postures for geometry instead of a motion");
DEFINE_string(instrument, "target",
              "what is measured at postures: target (position of a target on "
              "the tool), pose (of the tool)");
DEFINE_string(pose_noise, "0.0001,0.0001",
              "of what is measured at postures, m and rad");
DEFINE_string(given, "",
              "`FILES` logs or a calibration.json that exist: the "
              "motion adds what they "
              "do not tell");

namespace armcal {
namespace {

const FlagChoices<ExcitationCriterion> kCriteria(
    "criterion", {{"D", ExcitationCriterion::kD},
                  {"A", ExcitationCriterion::kA},
                  {"worst", ExcitationCriterion::kWorst}});
const FlagChoices<PoseInstrument> kInstruments(
    "instrument",
    {{"target", PoseInstrument::kTarget}, {"pose", PoseInstrument::kPose}});
const FlagChoices<DesignTarget> kTargets("target",
                                         {{"model", DesignTarget::kModel},
                                          {"physical", DesignTarget::kPhysical},
                                          {"geometry",
                                           DesignTarget::kGeometry}});

void CheckWithin(const char* flag, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw UsageError("--" + std::string(flag) + ": found '" + NumberText(value) +
                   "', expected a number from " + NumberText(low) + " to " +
                   NumberText(high));
}

void SetPositive(const char* flag, const std::string& text,
                 Eigen::VectorXd* values) {
  if (text.empty()) return;
  *values = ParsePerJoint(flag, text, static_cast<int>(values->size()));
  if (values->minCoeff() > 0) return;
  throw UsageError("--" + std::string(flag) + ": found '" + text +
                   "', expected numbers above 0");
}

void SetPositions(const std::string& text, MotionLimits* limits) {
  if (text.empty()) return;
  std::vector<TimeRange> ranges = ParseRanges("position_limits", text);
  const auto n = static_cast<size_t>(limits->lower.size());
  if (ranges.size() == 1) ranges.assign(n, ranges[0]);
  for (size_t j = 0; j < n; ++j) {
    if (ranges.size() == n && std::isfinite(ranges[j].begin) &&
        std::isfinite(ranges[j].end)) {
      limits->lower[j] = ranges[j].begin;
      limits->upper[j] = ranges[j].end;
      continue;
    }
    throw UsageError("--position_limits: found '" + text +
                     "', expected one lower:upper or " + std::to_string(n) +
                     ", with both ends");
  }
}

MotionLimits LimitsFromFlags(const FlagValues& flags, const Robot& robot,
                             std::vector<std::string>* assumed) {
  std::vector<std::string> of_file;
  MotionLimits limits = LimitsOf(robot, &of_file);
  SetPositions(flags.Text("position_limits"), &limits);
  SetPositive("velocity_limits", flags.Text("velocity_limits"),
              &limits.velocity);
  if (!flags.Text("velocity_limits").empty()) {
    limits.acceleration = 3 * limits.velocity;
  }
  SetPositive("acceleration_limits", flags.Text("acceleration_limits"),
              &limits.acceleration);
  SetPositive("effort_limits", flags.Text("effort_limits"), &limits.effort);
  const std::pair<const char*, std::string> given[] = {
      {"positions", flags.Text("position_limits")},
      {"velocities", flags.Text("velocity_limits")},
      {"accelerations", flags.Text("acceleration_limits")},
      {"any torque", flags.Text("effort_limits")}};
  for (const std::string& sentence : of_file) {
    bool set = false;
    for (const auto& [word, text] : given) {
      set = set || (sentence.rfind(word, 0) == 0 && !text.empty());
    }
    if (!set) assumed->push_back(sentence);
  }
  const double use = flags.Number("use");
  CheckWithin("use", use, .05, 1);
  return limits.Within(use);
}

Box ParseBox(const char* flag, const std::string& text) {
  const std::vector<TimeRange> ranges = ParseRanges(flag, text);
  bool whole = ranges.size() == 3;
  for (const TimeRange& range : ranges) {
    whole = whole && std::isfinite(range.begin) && std::isfinite(range.end);
  }
  if (!whole) {
    throw UsageError("--" + std::string(flag) + ": found '" + text +
                     "', expected x:x,y:y,z:z with all ends, m");
  }
  return {{ranges[0].begin, ranges[1].begin, ranges[2].begin},
          {ranges[0].end, ranges[1].end, ranges[2].end}};
}

Workspace WorkspaceFromFlags(const CommandInput& input, const Robot& robot,
                             const MotionLimits& limits) {
  const FlagValues& flags = input.flags;
  WorkspaceOptions options;
  options.link_radius = flags.Number("link_radius");
  CheckWithin("link_radius", options.link_radius, .005, 1);
  if (!flags.Text("tool_box").empty()) {
    options.tool_box = ParseBox("tool_box", flags.Text("tool_box"));
  }
  if (!flags.Text("floor").empty()) {
    const std::vector<double> height =
        ParseNumbers("floor", flags.Text("floor"));
    if (height.size() != 1) {
      throw UsageError("--floor: found '" + flags.Text("floor") +
                       "', expected one height, m");
    }
    options.floor = height[0];
  }
  std::istringstream boxes(flags.Text("obstacles"));
  for (std::string box; std::getline(boxes, box, ';');) {
    options.obstacles.push_back(ParseBox("obstacles", box));
  }
  return MakeForRobot(input, "within the limits ", [&] {
    return Workspace(robot, options, limits.lower, limits.upper);
  });
}

ExcitationCriterion CriterionFromFlags(const FlagValues& flags) {
  return kCriteria.Parse(flags.Text("criterion"));
}

}  // namespace

std::vector<FlagGroup> ExcitationFlagGroups() {
  return {{"what is to be learnt",
           {"robot", "target", "separate", "given", "static_poses"}},
          {"motion", {"duration", "floor", "obstacles", "tool_box"}},
          {"limits",
           {"position_limits", "velocity_limits", "acceleration_limits",
            "effort_limits"}},
          {"more of the motion",
           {"use", "criterion", "periods", "harmonics", "link_radius",
            "log_rate", "torque_noise", "trust", "length_trust", "seed"},
           false},
          {"postures", {"instrument", "pose_noise"}, false}};
}

ExcitationOptions ExcitationOptionsFromFlags(
    const CommandInput& input, const Robot& robot,
    std::vector<std::string>* assumed) {
  const FlagValues& flags = input.flags;
  // Hz, unless asked for: effects show in what is quick.
  const double highest = flags.Text("separate").empty() ? .5 : 1;
  ExcitationOptions options;
  CheckWithin("duration", flags.Number("duration"), .5, 1000);
  CheckWithin("periods", flags.Whole("periods"), 1, 100);
  options.duration_s = flags.Number("duration");
  options.periods = flags.Whole("periods");
  const double period = flags.Number("duration") / flags.Whole("periods");
  options.harmonics =
      std::max(5, static_cast<int>(std::lround(highest * period)));
  if (flags.Whole("harmonics") != 0) {
    CheckWithin("harmonics", flags.Whole("harmonics"), 2, 100);
    options.harmonics = flags.Whole("harmonics");
  }
  CheckWithin("log_rate", flags.Number("log_rate"), 1, 1e5);
  options.rate_hz = flags.Number("log_rate");
  options.criterion = CriterionFromFlags(flags);
  options.limits = LimitsFromFlags(flags, robot, assumed);
  options.workspace = WorkspaceFromFlags(input, robot, options.limits);
  if (options.workspace.empty()) {
    assumed->push_back("nothing is in the way (--floor, --obstacles)");
  }
  options.seed = SeedFromFlags(flags);
  return options;
}

std::optional<PostureOptions> PostureOptionsFromFlags(
    const CommandInput& input, const Robot& robot,
    std::vector<std::string>* assumed) {
  const FlagValues& flags = input.flags;
  if (flags.Whole("static_poses") == 0) return {};
  CheckWithin("static_poses", flags.Whole("static_poses"), 1, 1000);
  PostureOptions options;
  options.count = flags.Whole("static_poses");
  options.instrument = kInstruments.Parse(flags.Text("instrument"));
  options.criterion = CriterionFromFlags(flags);
  const std::vector<double> noise =
      ParseNumbers("pose_noise", flags.Text("pose_noise"));
  if (noise.size() != 2 || !(noise[0] > 0) || !(noise[1] > 0)) {
    throw UsageError("--pose_noise: found '" + flags.Text("pose_noise") +
                     "', expected two numbers above 0, m and rad");
  }
  options.noise = {noise[0], noise[1]};
  std::vector<std::string> sentences;
  const MotionLimits limits = LimitsFromFlags(flags, robot, &sentences);
  for (const std::string& sentence : sentences) {
    if (sentence.rfind("positions", 0) == 0) assumed->push_back(sentence);
  }
  options.lower = limits.lower;
  options.upper = limits.upper;
  options.workspace = WorkspaceFromFlags(input, robot, limits);
  options.seed = SeedFromFlags(flags);
  return options;
}

std::vector<const Effect*> SeparatedEffectsFromFlags(const FlagValues& flags) {
  return ParseEffects("separate", flags.Text("separate"));
}

DesignTarget TargetFromFlags(const FlagValues& flags) {
  return kTargets.Parse(flags.Text("target"));
}

Eigen::VectorXd NoiseSharesFromFlags(const FlagValues& flags, int num_joints) {
  const Eigen::VectorXd shares =
      ParsePerJoint("torque_noise", flags.Text("torque_noise"), num_joints);
  if (shares.minCoeff() > 0) return shares;
  throw UsageError("--torque_noise: found '" + flags.Text("torque_noise") +
                   "', expected numbers above 0");
}

Given GivenFromFlags(const FlagValues& flags) {
  const std::vector<std::string> paths = SplitAtCommas(flags.Text("given"));
  const auto is_calibration = [](const std::string& path) {
    return std::filesystem::path(path).extension() == ".json";
  };
  if (std::none_of(paths.begin(), paths.end(), is_calibration)) {
    return {paths, ""};
  }
  if (paths.size() > 1) {
    throw UsageError("--given=" + flags.Text("given") +
                     ": expected one calibration.json alone, or logs: a "
                     "calibration holds what its own logs tell");
  }
  return {{}, paths[0]};
}

}  // namespace armcal
