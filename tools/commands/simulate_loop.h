#pragma once

#include <string>

#include "model/plant/hidden/scenario.h"
#include "tools/command.h"
#include "tools/commands/simulate_flags.h"

namespace armcal {

struct ChosenRun {
  Scenario scenario;
  ScenarioRun run;
  std::string text;  // what was chosen, and why; empty: all as usual
};

// Runs what the flags ask for. Where they leave the loop open it has
// the gains of SteadyController. Where they leave the loop or the
// speed open and the usual ones drive a torque into its limit, slower ones are
// tried, as one does who sets up an arm: loops of half the bandwidth down to 1
// Hz, then motions of half the speed down to a quarter. The first with hardly a
// torque at its limit is taken, else that with the fewest. `usual`:
// ScenarioFromFlags(input).
ChosenRun RunWithUsualLoop(const CommandInput& input, Scenario usual);

}  // namespace armcal
