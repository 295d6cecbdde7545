#include "tools/simulate.h"

#include <gflags/gflags.h>

#include <iostream>

#include "model/input_text.h"
#include "model/log_writer.h"
#include "model/plant/hidden/truth_json.h"
#include "tools/command.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/progress_bar.h"
#include "tools/simulate_effects.h"
#include "tools/simulate_flags.h"
#include "tools/simulation_flags.h"

DECLARE_string(torque_constants);

DEFINE_bool(list_effects, false, "print the effects and their parameters");
DEFINE_bool(temperature, false, "log the joints' temperatures too");
DEFINE_string(truth, "", "folder for truth.json; default: --out");

namespace armcal {
namespace {

std::string Report(const Scenario& scenario, const ScenarioRun& run) {
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
  if (run.run.saturated_share > 0) {
    text += "a torque is at its limit in " +
            NumberText(100 * run.run.saturated_share) +
            " % of the time; --speed or --size below 1 moves more gently\n";
  }
  if (!run.run.finite) {
    text +=
        "the simulation diverged; the log ends there: the controller is "
        "unstable for this robot, or an effect too stiff for --step\n";
  }
  return text;
}

int Simulate() {
  if (FLAGS_list_effects) {
    std::cout << EffectList();
    return kExitOk;
  }
  Scenario scenario = ScenarioFromFlags();
  if (!LogRateFits(scenario.loop)) {
    throw UsageError("--log_rate: found '" +
                     NumberText(scenario.loop.sensors.log_rate_hz) +
                     "', expected Hz that divide the controller's rate of " +
                     NumberText(scenario.loop.controller.rate_hz));
  }
  if (OutFromFlags().empty()) throw UsageError("--out=DIR is needed");
  ProgressBar bar;
  scenario.loop.progress = [&bar](double share) {
    bar.Show("simulating", share);
  };
  ScenarioRun run = RunScenario(scenario);
  if (!FLAGS_temperature) run.run.log.temperature.resize(0, 0);
  LogWriterOptions writer;
  if (!FLAGS_torque_constants.empty()) {
    const Eigen::VectorXd constants =
        ParsePerJoint("torque_constants", FLAGS_torque_constants,
                      scenario.model.num_joints());
    writer.torque_constants.assign(constants.begin(), constants.end());
  }
  OutputFolder out(OutFromFlags());
  out.Add("log.csv", LogText(run.run.log, writer));
  OutputFolder secret(FLAGS_truth, "--truth");
  (FLAGS_truth.empty() ? out : secret)
      .Add("truth.json", TruthJson(scenario, run).dump(2) + "\n");
  secret.Write();
  out.Write();
  std::cout << Report(scenario, run);
  return run.run.finite ? kExitOk : kExitNegative;
}

constexpr const char* kFlags[] = {"robot",
                                  "effects",
                                  "list_effects",
                                  "robot_error",
                                  "motion",
                                  "duration",
                                  "size",
                                  "speed",
                                  "joints",
                                  "standstill",
                                  "controller",
                                  "friction_width",
                                  "encoder_resolution",
                                  "encoder_noise",
                                  "torque_noise",
                                  "coloured_noise",
                                  "noise_correlation",
                                  "torque_delay",
                                  "torque_constants",
                                  "temperature",
                                  "log_rate",
                                  "jitter",
                                  "lost",
                                  "step",
                                  "seed",
                                  "run",
                                  "out",
                                  "truth",
                                  "base",
                                  "tip",
                                  "gravity"};

}  // namespace

Command SimulateCommand() {
  return {"simulate",
          "writes the log of a simulated robot with hidden effects, and the "
          "truth in a separate file",
          {std::begin(kFlags), std::end(kFlags)},
          Simulate};
}

}  // namespace armcal
