#include "calib/diagnose/next_steps.h"

#include <algorithm>

#include "calib/diagnose/sentence.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

constexpr double kWorthIt = .1;     // of what has no name
constexpr size_t kExperiments = 3;  // more would not be done

// Experiments for what may be there: the claims first, then what one name of
// several is claimed of, then what is not claimed.
std::vector<std::string> Experiments(const GapDiagnosis& diagnosis) {
  std::vector<std::string> steps;
  const auto add = [&](const std::string& why, const FoundEffect& found) {
    const bool has_others = !found.separate_by.empty();
    const std::string& experiment =
        has_others ? found.separate_by : found.effect->experiment;
    if (steps.size() == kExperiments || found.of_another_day) return;
    if (experiment.empty()) return;
    const std::string name = NameOf(*found.effect, found.joint, diagnosis);
    steps.push_back((has_others ? "to tell " + name + " from what is like it"
                                : why + name) +
                    ": " + experiment);
  };
  for (const FoundEffect& found : diagnosis.effects) {
    if (!IsConfident(found.probability)) add("to be sure of ", found);
  }
  for (const FoundEffect& found : diagnosis.unnamed) {
    if (found.one_of_few) add("to be sure of ", found);
  }
  for (const FoundEffect& found : diagnosis.unnamed) {
    if (found.probability >= kWorthIt && !found.one_of_few) {
      add("to see whether it is ", found);
    }
  }
  return steps;
}

// Whether it is of the robot and not of a log or a moment.
bool IsOfTheRobot(const FoundEffect& found) {
  using Nature = Effect::Nature;
  const Nature nature = found.effect->nature;
  return nature != Nature::kRecording && nature != Nature::kEvent &&
         !found.of_another_day;
}

}  // namespace

std::vector<std::string> NextSteps(const GapDiagnosis& diagnosis) {
  std::vector<std::string> steps;
  const GapVerdict verdict = diagnosis.verdict;
  if (verdict == GapVerdict::kNotTestable) return steps;
  steps = Experiments(diagnosis);
  const bool is_of_file = SinceWhat(diagnosis).empty();
  if (verdict == GapVerdict::kUnknown && is_of_file) {
    steps.push_back("a log of the same motion from before it went wrong, as " +
                    OptionName("reference") +
                    ": then only what has changed is asked for");
  }
  if (verdict == GapVerdict::kAbsorbed && is_of_file) {
    steps.push_back(
        "armcal calibrate gives such values with their deviations, of a robot "
        "that can exist: the better, the more motion it sees");
  }
  const bool nothing_seen =
      verdict == GapVerdict::kNoiseFloor || verdict == GapVerdict::kAbsorbed;
  if (nothing_seen && !diagnosis.untestable.empty()) {
    steps.push_back("what this motion cannot show, another may: armcal excite");
  }
  if (std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(),
                  IsOfTheRobot)) {
    steps.push_back("for a simulator: " + OptionName("export") + " and " +
                    OptionName("modules") +
                    " write the robot with what it was found to have");
  }
  return steps;
}

}  // namespace armcal
