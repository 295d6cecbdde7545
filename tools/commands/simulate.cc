#include "tools/commands/simulate.h"

#include <gflags/gflags.h>

#include <utility>

#include "model/log_files/log_writer.h"
#include "model/plant/hidden/truth_json.h"
#include "model/plant/robot_variation.h"
#include "model/text/format.h"
#include "model/text/input_text.h"
#include "tools/command.h"
#include "tools/command_report.h"
#include "tools/commands/simulate_effects.h"
#include "tools/commands/simulate_flags.h"
#include "tools/commands/simulate_loop.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/simulation_flags.h"

DEFINE_bool(list_effects, false, "print the effects and their parameters");
DEFINE_bool(temperature, false, "log the joints' temperatures too");
DEFINE_string(truth, "", "`DIR` for truth.json; default: --out");

namespace armcal {
namespace {

// Where the arm is far from what it was told, rad or m.
std::string TrackingText(const ScenarioRun& run) {
  constexpr double kFar = .05;
  std::string text;
  for (int j = 0; j < run.run.tracking_rms.size(); ++j) {
    const double error = run.run.tracking_rms[j];
    if (!(error > kFar)) continue;
    const Joint& joint = run.robot.links[j].joint;
    text += joint.name + Format(" does not follow: %.3g ", error) +
            PositionUnit(joint.type) + " rms off its reference\n";
  }
  return text;
}

// Links of the file that no real robot can have.
std::string PossibleText(Robot robot) {
  std::string text;
  for (const std::string& link : MakeLinksPossible(&robot)) {
    text += "no body has the inertia of " + link +
            ": the simulated robot has the nearest that one can have\n";
  }
  return text;
}

std::string Report(const ChosenRun& chosen) {
  const Scenario& scenario = chosen.scenario;
  const ScenarioRun& run = chosen.run;
  const Log& log = run.run.log;
  std::string text = "simulated " + scenario.model.name + ": " +
                     std::to_string(log.size()) + " samples, " +
                     NumberText(log.size() ? log.t[log.size() - 1] : 0) +
                     " s\n";
  for (const AppliedEffect& effect : run.effects) {
    text += "  " + effect.name;
    if (effect.joint >= 0) {
      text += " on " + run.robot.links[effect.joint].joint.name;
    }
    for (const EffectValue& value : effect.values) {
      text += ", " + value.name + " " + NumberText(value.value) +
              (value.unit == "1" ? "" : " " + value.unit);
    }
    text += "\n";
  }
  text += PossibleText(scenario.model) + chosen.text;
  if (run.run.saturated_share > 0) {
    text += "a torque is at its limit in " +
            Format("%.3g %% of the time; ", 100 * run.run.saturated_share) +
            (run.run.saturated_share > .5
                 ? "the limits or the controller do not suit this robot\n"
                 : "--speed or --size below 1 moves more gently\n");
  }
  text += TrackingText(run);
  if (!run.run.finite) {
    text +=
        "the simulation diverged; the log ends there: the controller is "
        "unstable for this robot, or an effect too stiff for --step\n";
  }
  return text;
}

LogWriterOptions WriterFromFlags(const FlagValues& flags, int num_joints) {
  LogWriterOptions writer;
  if (flags.Text("torque_constants").empty()) return writer;
  const Eigen::VectorXd constants = ParsePerJoint(
      "torque_constants", flags.Text("torque_constants"), num_joints);
  if (constants.minCoeff() == 0) {
    throw UsageError("--torque_constants: found '" +
                     flags.Text("torque_constants") +
                     "', expected numbers above 0");
  }
  writer.torque_constants.assign(constants.begin(), constants.end());
  return writer;
}

// A log's times, and where links truly were: behind gears that yield no encoder
// of a motor sees them.
std::string LinkText(const ClosedLoopRun& run) {
  Log links;
  links.t = run.log.t;
  links.q = run.link_position;
  return LogText(links);
}

CommandOutcome Simulate(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  CommandOutcome outcome;
  if (flags.Switch("list_effects")) {
    outcome.output = {EffectListJson(), EffectList(), "", true, {}};
    return outcome;
  }
  Scenario scenario = ScenarioFromFlags(input);
  if (!LogRateFits(scenario.loop)) {
    throw UsageError("--log_rate: found '" +
                     NumberText(scenario.loop.sensors.log_rate_hz) +
                     "', expected Hz that divide the controller's rate of " +
                     NumberText(scenario.loop.controller.rate_hz));
  }
  if (OutFromFlags(flags).empty() && !input.report) {
    throw UsageError("--out=DIR is needed");
  }
  const LogWriterOptions writer =
      WriterFromFlags(flags, scenario.model.num_joints());
  input.Begin("simulating");
  ChosenRun chosen = RunWithUsualLoop(input, std::move(scenario));
  ScenarioRun& run = chosen.run;
  if (!flags.Switch("temperature")) run.run.log.temperature.resize(0, 0);
  OutputFolder out(OutFromFlags(flags)), secret(flags.Text("truth"), "--truth");
  run.run.log.simulated = true;
  out.Add("log.csv", LogText(run.run.log, writer));
  const std::string truth = TruthJson(chosen.scenario, run).dump(2) + "\n";
  // Beside the truth, as its command line has the effects.
  OutputFolder& told = flags.Text("truth").empty() ? out : secret;
  told.Add("truth.json", truth);
  if (run.run.link_position.size() > 0) {
    told.Add("links.csv", LinkText(run.run));
  }
  std::vector<std::string> motion = {flags.Text("motion")};
  if (motion[0] == "fourier" || motion[0] == "points") motion.clear();
  AddProvenance(input, "simulate", motion, &told);
  outcome.folders = {secret, out};
  outcome.output = {truth, Report(chosen), "", run.run.finite, {}};
  return outcome;
}

}  // namespace

Command SimulateCommand() {
  return {"simulate",
          "writes the log of a simulated robot with hidden effects, and the "
          "truth in a separate file",
          {{"robot", {"robot", "effects", "list_effects", "robot_error"}},
           {"motion", {"motion", "duration", "size", "speed"}},
           {"log", {"log_rate", "truth", "seed", "run"}},
           {"more of the motion",
            {"joints", "standstill", "controller", "friction_width", "step"},
            false},
           {"sensors",
            {"encoder_resolution", "encoder_noise", "torque_noise",
             "coloured_noise", "noise_correlation", "torque_delay",
             "torque_constants", "temperature", "jitter", "lost"},
            false},
           ChainFlags()},
          {"armcal simulate --robot=arm.urdf --effects=stribeck@2 --out=run "
           "--truth=secret",
           "armcal simulate --list_effects"},
          Simulate};
}

}  // namespace armcal
