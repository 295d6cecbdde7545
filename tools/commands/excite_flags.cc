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
#include "tools/log_flags.h"
#include "tools/simulation_flags.h"
#include "tools/trust_flags.h"

DEFINE_string(target, "model",
              "what the motion is to tell: model (parameters), physical "
              "(inertias, friction), geometry (lengths)");
DEFINE_string(criterion, "D",
              "what is to be small: D (volume of the confidence ellipsoid), A "
              "(sum of variances), worst (largest standard deviation)");
DEFINE_string(
    separate, "",
    "`A,B[,..]` effects that the motion, or postures, are to tell apart on "
    "every joint, instead of a --target");
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

// One number for all of n joints, or one for each, above 0; none: nothing is
// asked for.
Eigen::VectorXd PositiveFromFlags(const FlagValues& flags, const char* flag,
                                  int n) {
  const std::string text = flags.Text(flag);
  if (text.empty()) return {};
  const Eigen::VectorXd values = ParsePerJoint(flag, text, n);
  if (values.minCoeff() > 0) return values;
  throw UsageError("--" + std::string(flag) + ": found '" + text +
                   "', expected numbers above 0");
}

void SetPositions(const std::string& text, int n, ExcitationLimits* limits) {
  if (text.empty()) return;
  std::vector<TimeRange> ranges = ParseRanges("position_limits", text);
  if (ranges.size() == 1) ranges.assign(n, ranges[0]);
  limits->lower.resize(n);
  limits->upper.resize(n);
  for (int j = 0; j < n; ++j) {
    if (static_cast<int>(ranges.size()) == n &&
        std::isfinite(ranges[j].begin) && std::isfinite(ranges[j].end)) {
      limits->lower[j] = ranges[j].begin;
      limits->upper[j] = ranges[j].end;
      continue;
    }
    throw UsageError("--position_limits: found '" + text +
                     "', expected one lower:upper or " + std::to_string(n) +
                     ", with both ends");
  }
}

ExcitationLimits LimitsFromFlags(const FlagValues& flags, int n) {
  ExcitationLimits limits;
  SetPositions(flags.Text("position_limits"), n, &limits);
  limits.velocity = PositiveFromFlags(flags, "velocity_limits", n);
  limits.acceleration = PositiveFromFlags(flags, "acceleration_limits", n);
  limits.effort = PositiveFromFlags(flags, "effort_limits", n);
  limits.use = flags.Number("use");
  return limits;
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

WorkspaceOptions WorkspaceFromFlags(const FlagValues& flags) {
  WorkspaceOptions options;
  options.link_radius = flags.Number("link_radius");
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
  return options;
}

std::optional<StaticPoses> PosesFromFlags(const FlagValues& flags) {
  if (flags.Whole("static_poses") == 0) return {};
  StaticPoses poses;
  poses.count = flags.Whole("static_poses");
  poses.instrument = kInstruments.Parse(flags.Text("instrument"));
  const std::vector<double> noise =
      ParseNumbers("pose_noise", flags.Text("pose_noise"));
  if (noise.size() != 2 || !(noise[0] > 0) || !(noise[1] > 0)) {
    throw UsageError("--pose_noise: found '" + flags.Text("pose_noise") +
                     "', expected two numbers above 0, m and rad");
  }
  poses.position_noise = noise[0];
  poses.rotation_noise = noise[1];
  return poses;
}

// Logs, or one calibration.json.
void SetGiven(const CommandInput& input, ExciteOptions* options) {
  const FlagValues& flags = input.flags;
  const std::vector<std::string> paths = SplitAtCommas(flags.Text("given"));
  const auto is_calibration = [](const std::string& path) {
    return std::filesystem::path(path).extension() == ".json";
  };
  if (std::none_of(paths.begin(), paths.end(), is_calibration)) {
    options->given = {SourcesOf(input, paths), CropFromFlags(flags)};
    return;
  }
  if (paths.size() > 1) {
    throw UsageError("--given=" + flags.Text("given") +
                     ": expected one calibration.json alone, or logs: a "
                     "calibration holds what its own logs tell");
  }
  options->given_calibration = paths[0];
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

ExciteOptions ExciteOptionsFromFlags(const CommandInput& input,
                                     const Robot& robot) {
  const FlagValues& flags = input.flags;
  ExciteOptions options;
  options.target = kTargets.Parse(flags.Text("target"));
  options.poses = PosesFromFlags(flags);
  if (options.poses) {
    options.separate = SplitAtCommas(flags.Text("separate"));
  } else {
    for (const Effect* effect :
         ParseEffects("separate", flags.Text("separate"))) {
      options.separate.push_back(effect->name);
    }
  }
  options.duration_s = flags.Number("duration");
  options.periods = flags.Whole("periods");
  options.harmonics = flags.Whole("harmonics");
  options.rate_hz = flags.Number("log_rate");
  options.criterion = kCriteria.Parse(flags.Text("criterion"));
  options.limits = LimitsFromFlags(flags, robot.num_joints());
  options.workspace = WorkspaceFromFlags(flags);
  options.torque_noise =
      PositiveFromFlags(flags, "torque_noise", robot.num_joints());
  options.trust = TrustFromFlags(flags);
  SetGiven(input, &options);
  options.reading = LogOptionsFromFlags(flags, robot);
  options.bandwidth_hz = BandwidthFromFlags(flags);
  options.seed = SeedFromFlags(flags);
  options.source = RobotSourceFromFlags(input);
  options.progress = input.progress;
  return options;
}

}  // namespace armcal
