#include "tools/commands/excite.h"

#include "calib/excite.h"
#include "tools/command_report.h"
#include "tools/commands/excite_flags.h"
#include "tools/input_flags.h"
#include "tools/report/report_data.h"

namespace armcal {
namespace {

// Positions and velocities of one period.
nlohmann::json MotionJson(const Robot& robot, const Log& motion) {
  if (motion.size() == 0) return nullptr;
  nlohmann::json joints = nlohmann::json::array();
  for (const Link& link : robot.links) {
    joints.push_back(
        {{"name", link.joint.name}, {"unit", PositionUnit(link.joint.type)}});
  }
  return {{"t", RoundedJson(motion.t)},
          {"q", SignalsJson(motion.q)},
          {"qd", SignalsJson(motion.qd)},
          {"joints", joints}};
}

CommandOutcome RunExcite(const CommandInput& input) {
  const Robot robot = RobotFromFlags(input);
  const ExciteOptions options = ExciteOptionsFromFlags(input, robot);
  const ExciteSummary summary = Excite(robot, options);
  CommandOutcome outcome = OutcomeOf(input, robot, summary, {});
  outcome.output.verdict = "";
  std::vector<std::string> files = NamesOf(options.given.logs);
  if (!options.given_calibration.empty()) {
    files.push_back(options.given_calibration);
  }
  AddReport(
      input, "excite", robot, summary.json, files,
      [&](ReportContent* content) {
        if (options.poses) {
          content->extra["postures"] = PosturesJson(robot, summary.poses);
        } else {
          content->extra["motion"] = MotionJson(robot, summary.motion);
        }
      },
      &outcome.folders[0]);
  return outcome;
}

}  // namespace

Command ExciteCommand() {
  std::vector<FlagGroup> groups = ExcitationFlagGroups();
  FlagGroup logs = {"logs that exist", {"bandwidth", "crop"}, false};
  for (const auto& flag : TorqueFlags().flags) logs.flags.push_back(flag);
  groups.push_back(logs);
  groups.push_back(ChainFlags());
  return {
      "excite",
      "the motion that tells most about a robot within its limits, and how "
      "well it will tell",
      groups,
      {"armcal excite --robot=arm.urdf --duration=20 --floor=0 --out=motion",
       "armcal excite --robot=arm.urdf --separate=elasticity,delay "
       "--given=log.csv"},
      &RunExcite};
}

}  // namespace armcal
