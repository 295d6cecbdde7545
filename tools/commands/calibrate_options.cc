#include "tools/commands/calibrate_options.h"

#include <gflags/gflags.h>

#include "tools/commands/calibrate_flags.h"
#include "tools/export_flags.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"
#include "tools/pose_flags.h"
#include "tools/trust_flags.h"

DEFINE_bool(select, false,
            "calibrate on the segments of the logs that tell most, as few as "
            "tell nearly all");
DEFINE_double(segment, 5, "`S` length of segments for --select");
DEFINE_string(
    estimate, "auto",
    "refined (model parameters and a physically consistent robot for "
    "simulators), linear (model parameters only), auto (refined where "
    "the file has masses)");
DEFINE_string(trajectory, "measured",
              "measured (recorded positions as they are, in weak rows), "
              "corrected (maximum likelihood: splines through all motions, "
              "fitted to positions and torques; for noisy encoders)");
DEFINE_string(payload_mass, "",
              "`KG` of the payload in --payload_log: the torque constants are "
              "estimated from the currents of --log (bare arm) and "
              "--payload_log");
DEFINE_string(payload_log, "",
              "`FILES` logs of the same arm with a payload of "
              "--payload_mass fixed to its last link");
DEFINE_double(gains_trust, 0,
              "with --controller: relative standard deviation of its gains, "
              "which are then estimated; 0: exact");
DEFINE_double(delay_trust, 0.02,
              "`S` with --controller: standard deviation of the command's "
              "delay, which is then estimated; 0: exact");
DEFINE_string(torque_log, "",
              "`FILES` logs with torques of the same arm, beside --log's of "
              "commands: one estimate is made of both");

namespace armcal {
namespace {

const FlagChoices<CalibrationTarget> kCalibrationTargets(
    "estimate", {{"auto", CalibrationTarget::kAuto},
                 {"refined", CalibrationTarget::kRefined},
                 {"linear", CalibrationTarget::kLinear}});
const FlagChoices<bool> kTrajectories("trajectory", {{"measured", false},
                                                     {"corrected", true}});
// Those of --geometry that need no log.
const FlagChoices<RefineGeometry> kPoseGeometries(
    "geometry", {{"known", RefineGeometry::kNothing},
                 {"offsets", RefineGeometry::kOffsets},
                 {"refine", RefineGeometry::kAll}});

bool HasPosesAlone(const FlagValues& flags) {
  return !flags.Text("poses").empty() && flags.Text("log").empty();
}

RefineGeometry GeometryFromFlags(const FlagValues& flags) {
  if (flags.Text("geometry") == "offsets") return RefineGeometry::kOffsets;
  if (flags.Text("geometry") == "refine") return RefineGeometry::kAll;
  return RefineGeometry::kNothing;
}

std::optional<PayloadLogs> PayloadFromFlags(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  const std::string mass = flags.Text("payload_mass");
  const std::string logs = flags.Text("payload_log");
  if (mass.empty() && logs.empty()) return std::nullopt;
  if (mass.empty() || logs.empty()) {
    throw UsageError("--payload_mass=KG and --payload_log=FILE go together");
  }
  return PayloadLogs{PositiveNumber("payload_mass", mass),
                     SourcesOf(input, FileNames("payload_log", logs))};
}

std::optional<CommandedCalibrationOptions> CommandsFromFlags(
    const CommandInput& input) {
  const FlagValues& flags = input.flags;
  const std::string torque_logs = flags.Text("torque_log");
  if (flags.Text("controller").empty()) {
    if (torque_logs.empty()) return std::nullopt;
    throw UsageError(
        "--torque_log: found no --controller beside it, expected logs of "
        "commands in --log; logs with torques alone are --log's");
  }
  CommandedCalibrationOptions options;
  options.controller = flags.Text("controller");
  options.gains_trust = flags.Number("gains_trust");
  options.delay_trust = flags.Number("delay_trust");
  options.torque_logs = SourcesOf(input, SplitAtCommas(torque_logs));
  return options;
}

}  // namespace

LogInput CalibrationLogsFromFlags(const CommandInput& input) {
  return HasPosesAlone(input.flags) ? LogInput() : LogInputFromFlags(input);
}

CalibrateOptions CalibrateOptionsFromFlags(const CommandInput& input,
                                           const Robot& robot) {
  const FlagValues& flags = input.flags;
  CalibrateOptions options;
  const bool poses_alone = HasPosesAlone(flags);
  if (poses_alone) {
    options.geometry = kPoseGeometries.Parse(flags.Text("geometry"));
    options.equations.loss = LossFromFlags(flags);
  } else {
    options.commands = CommandsFromFlags(input);
    options.equations = LinearOptionsFromFlags(flags, robot);
    options.target = kCalibrationTargets.Parse(flags.Text("estimate"));
    options.geometry = GeometryFromFlags(flags);
    options.correct_trajectories =
        kTrajectories.Parse(flags.Text("trajectory"));
    if (flags.Switch("select")) options.select_s = flags.Number("segment");
    options.reading = LogOptionsFromFlags(flags, robot);
    options.validation = ValidationInputFromFlags(input);
    options.payload = PayloadFromFlags(input);
  }
  const ExportChoice exports = ExportFromFlags(flags);
  options.exports = exports.formats;
  options.samples = exports.samples;
  options.trust = TrustFromFlags(flags);
  if (!flags.Text("poses").empty()) {
    options.poses = PosesFromFlags(flags, robot);
  }
  const std::string held_out = flags.Text("validate");
  if (poses_alone && !held_out.empty()) {
    options.pose_validation = PosesFromFile(flags, robot, held_out);
  }
  options.source = RobotSourceFromFlags(input);
  options.draw_torques = input.WantsReport();
  options.progress = input.progress;
  return options;
}

std::vector<std::string> CalibrationFilesFromFlags(const CommandInput& input) {
  std::vector<std::string> files =
      NamesOf(CalibrationLogsFromFlags(input).logs);
  for (const char* flag : {"validate", "payload_log", "poses", "torque_log"}) {
    const auto more = SplitAtCommas(input.flags.Text(flag));
    files.insert(files.end(), more.begin(), more.end());
  }
  const auto cameras = CameraFiles(input.flags);
  files.insert(files.end(), cameras.begin(), cameras.end());
  return files;
}

}  // namespace armcal
