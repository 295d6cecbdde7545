#include "tools/commands/simulate_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/dynamics/joint_controller.h"
#include "model/text/format.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

// Of the time: a motor that is at its limit more often follows no command.
constexpr double kHardly = .01;

bool Suits(const ScenarioRun& run) {
  return run.run.finite && run.run.saturated_share <= kHardly;
}

bool IsBetter(const ScenarioRun& run, const ScenarioRun& than) {
  if (run.run.finite != than.run.finite) return run.run.finite;
  return run.run.saturated_share < than.run.saturated_share;
}

ChosenRun RunWith(const CommandInput& input, Scenario scenario) {
  ChosenRun chosen;
  chosen.scenario = std::move(scenario);
  chosen.scenario.loop.progress = [&input](double share) {
    if (input.progress) input.progress("simulating", share);
  };
  chosen.run = RunScenario(chosen.scenario);
  return chosen;
}

// Takes a slower loop where it is better; whether it suits.
bool Try(const CommandInput& input, const UsualLoop& slower, UsualLoop* loop,
         ChosenRun* chosen) {
  ChosenRun next = RunWith(input, ScenarioFromFlags(input, slower));
  if (IsBetter(next.run, chosen->run)) {
    *loop = slower;
    *chosen = std::move(next);
  }
  return Suits(chosen->run);
}

// Joints whose gains are below those of the bandwidth, and how far at most.
std::string RingingText(const Scenario& scenario, double bandwidth_hz) {
  const ControllerOptions usual =
      DefaultController(scenario.model, scenario.motion.at(0).q, bandwidth_hz);
  std::string joints;
  double least = 1;
  for (int j = 0; j < scenario.model.num_joints(); ++j) {
    const double share =
        scenario.loop.controller.drives[j].kd / usual.drives[j].kd;
    if (share > .99) continue;
    joints += (joints.empty() ? "" : ", ") + scenario.model.links[j].joint.name;
    least = std::min(least, share);
  }
  if (joints.empty()) return "";
  return "gains of " + joints + " down to " +
         NumberText(std::round(100 * least)) + " % of loops of " +
         NumberText(bandwidth_hz) +
         " Hz: these would ring where other joints, free to move as well, "
         "leave them little inertia\n";
}

std::string LimitText(const UsualLoop& loop, double usual_share) {
  std::string text;
  if (loop.bandwidth_hz != kUsualBandwidthHz) {
    text = "loops of " + NumberText(loop.bandwidth_hz) + " Hz";
  }
  if (loop.speed != 1) {
    text += (text.empty() ? "" : " and ") + NumberText(100 * loop.speed) +
            " % of the usual speed";
  }
  if (text.empty()) return "";
  return text + ": with loops of " + NumberText(kUsualBandwidthHz) +
         " Hz at usual speed a torque was at its limit in " +
         Format("%.3g %% of the time\n", 100 * usual_share);
}

}  // namespace

ChosenRun RunWithUsualLoop(const CommandInput& input, Scenario usual) {
  const FlagValues& flags = input.flags;
  UsualLoop loop;
  const bool open = flags.Text("controller").empty();
  ChosenRun chosen = RunWith(input, std::move(usual));
  bool suits = Suits(chosen.run);
  const double usual_share = chosen.run.run.saturated_share;
  if (open) {
    for (double hz = kUsualBandwidthHz / 2; !suits && hz >= 1; hz /= 2) {
      suits = Try(input, {hz, 1}, &loop, &chosen);
    }
  }
  const bool drawn =
      flags.Text("motion") == "fourier" || flags.Text("motion") == "points";
  if (drawn && flags.IsDefault("speed")) {
    for (double speed = .5; !suits && speed >= .25; speed /= 2) {
      suits = Try(input, {loop.bandwidth_hz, speed}, &loop, &chosen);
    }
  }
  if (open) chosen.text = RingingText(chosen.scenario, loop.bandwidth_hz);
  chosen.text += LimitText(loop, usual_share);
  return chosen;
}

}  // namespace armcal
