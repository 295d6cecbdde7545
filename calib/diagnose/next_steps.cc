#include "calib/diagnose/next_steps.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/names.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// An experiment is proposed for what is named or nearly so, and would matter: a
// weak guess is one of many, and what removes a hundredth of the gap is not
// what the gap is.
constexpr double kNearlyNamed = .2;   // probability
constexpr double kWorthRemoving = 5;  // %, of what refitting leaves, or of
                                      // the noise where that is more
constexpr size_t kExperiments = 3;    // more would not be done

bool IsFriction(JointTerm term) {
  return term == JointTerm::kViscous || term == JointTerm::kCoulomb;
}

// Whether an effect is friction of a joint: such a number, or a law for which
// such numbers stand in robot files.
bool IsFriction(const Effect& effect) {
  return (effect.joint_term && IsFriction(*effect.joint_term)) ||
         std::any_of(effect.stand_ins.begin(), effect.stand_ins.end(),
                     [](JointTerm term) { return IsFriction(term); });
}

// Whether joints' friction is said to differ from that of a single reference,
// by a name or by more than is usual from day to day (two standard deviations).
// A joint's friction differs from log to log by itself, and one log of the
// robot as it was does not tell by how much.
bool IsFrictionSinceOneLog(const GapDiagnosis& diagnosis) {
  constexpr double kUnusual = 2;
  const auto& effects = diagnosis.effects;
  const auto& moved = diagnosis.moved;
  if (diagnosis.reference_logs != 1) return false;
  return std::any_of(effects.begin(), effects.end(),
                     [](const FoundEffect& found) {
                       return IsFriction(*found.effect);
                     }) ||
         std::any_of(moved.begin(), moved.end(), [](const MovedParameter& one) {
           return one.term && IsFriction(*one.term) &&
                  std::abs(one.deviations) > kUnusual;
         });
}

// Whether what an effect removes of held-out torque is too little to ask for.
// What refitting leaves is next to nothing where it is a tenth of the noise.
bool IsTrifle(const FoundEffect& found, const GapFigures& torque) {
  const double left = torque.refit - 1;
  return found.removed_percent * left < kWorthRemoving * std::max(1., left);
}

// What has no name of its own but is worth an experiment: one name of several
// that is claimed of them first, then what is nearly named, what removes the
// most first. What that is may not be known: last.
std::vector<const FoundEffect*> NearlyNamed(const GapDiagnosis& diagnosis) {
  std::vector<const FoundEffect*> found;
  for (const FoundEffect& one : diagnosis.unnamed) {
    const bool is_near =
        one.probability >= kNearlyNamed && !IsTrifle(one, diagnosis.torque);
    if (one.one_of_few || is_near) found.push_back(&one);
  }
  const auto removes = [](const FoundEffect& one) {
    return std::isnan(one.removed_percent) ? -1 : one.removed_percent;
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const FoundEffect* a, const FoundEffect* b) {
                     if (a->one_of_few != b->one_of_few) return a->one_of_few;
                     return removes(*a) > removes(*b);
                   });
  return found;
}

// Experiments for what may be there: the claims first, then what is nearly one.
std::vector<std::string> Experiments(const GapDiagnosis& diagnosis) {
  std::vector<std::string> steps;
  const auto add = [&](const std::string& why, const FoundEffect& found) {
    const bool has_others = !found.separate_by.empty();
    const std::string& experiment =
        has_others ? found.separate_by : found.effect->experiment;
    if (steps.size() == kExperiments || found.of_another_day) return;
    if (experiment.empty()) return;
    const std::string name = NameOf(found, diagnosis);
    steps.push_back((has_others ? "to tell " + name + " from what is like it"
                                : why + name) +
                    ": " + experiment);
  };
  if (IsFrictionSinceOneLog(diagnosis)) {
    steps.push_back("a second log of the robot as it was, of another day, as " +
                    OptionName("reference") +
                    ": two tell how much friction differs from log to log by "
                    "itself");
  }
  for (const FoundEffect& found : diagnosis.effects) {
    const bool has_place = found.or_at.empty();
    if (!IsConfident(found.probability) || !has_place) {
      add("to be sure of ", found);
    }
  }
  for (const FoundEffect* found : NearlyNamed(diagnosis)) {
    add(found->one_of_few ? "to be sure of " : "to see whether it is ", *found);
  }
  return steps;
}

// A reference that moves as this log does, where one that does not leaves three
// quarters of the noise's variance, or more, to what is not known of such
// motion. Empty where it leaves less.
std::string ReferenceOfThisMotion(const GapDiagnosis& diagnosis) {
  const auto worst =
      std::max_element(diagnosis.joints.begin(), diagnosis.joints.end(),
                       [](const JointGap& a, const JointGap& b) {
                         return a.beyond_reference < b.beyond_reference;
                       });
  constexpr double kMostOfTheVariance = 2;
  if (worst == diagnosis.joints.end() ||
      worst->beyond_reference < kMostOfTheVariance) {
    return "";
  }
  return Format(
      "a reference that moves as fast as this log: beyond the speeds and "
      "accelerations that the reference has, what its model leaves of %s may "
      "be %.3g times as large",
      worst->name.c_str(), worst->beyond_reference);
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
  const std::string reference = ReferenceOfThisMotion(diagnosis);
  if (!reference.empty()) steps.push_back(reference);
  if (std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(),
                  IsOfTheRobot)) {
    steps.push_back("for a simulator: " + OptionName("export") + " and " +
                    OptionName("modules") +
                    " write the robot with what it was found to have");
  }
  return steps;
}

}  // namespace armcal
