#include "calib/diagnose/judge/verdict.h"

#include <cmath>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

// Chi squared of n rows that hold noise alone has the mean n and the variance 2
// n.
double UnexplainedOf(const JointLeft& left) {
  // What is real is there again in what was held out.
  if (left.held_out > 0 && left.held_out < 1) return 0;
  const double by_chance = Limits().clear_of_many * std::sqrt(2. * left.rows);
  if (left.excess < by_chance) return 0;
  // Without any order, it may be noise that is louder here than where it was
  // told: up to twice; in motion, where clocks and encoders err, to twice the
  // standard deviation at rest.
  const double louder = left.floor == NoiseFloor::kStandstill
                            ? Limits().louder_in_motion
                            : Limits().extra_variance_of_others;
  if (!left.is_ordered && left.excess < louder * left.rows) return 0;
  return left.excess;
}

double LoudestNoise() { return 1 + Limits().extra_variance_of_others; }

bool IsLoudHeldOut(const GapFacts& facts) {
  return facts.torque.known() && !facts.effects &&
         facts.torque.refit > LoudestNoise();
}

// What the figures come to. What is left of all joints in sample, none of it
// chance (UnexplainedOf), counts where it is more than Limits().left of what a
// refit leaves; of held-out data, where it is more than Limits().left of the
// noise and of their gap. A refit that leaves half of what
// the file left absorbed it: numbers of the file, not a law, were the reason.
// Without held-out data nothing can be confirmed, and what was found is `partly
// explained` at best; more than the noise of a reference, which was told in
// other motions than these, is then no change.
GapVerdict JudgeGap(const GapFacts& facts) {
  const bool much_left = facts.left > 0 && facts.left_share > Limits().left;
  if (!facts.torque.known()) {
    if (facts.effects) return GapVerdict::kPartlyExplained;
    const bool unknown =
        (much_left && !facts.since_reference) || facts.found_without_name;
    return unknown ? GapVerdict::kUnknown : GapVerdict::kNotTestable;
  }
  const double after = facts.torque.after - 1;
  const double nominal = facts.torque.nominal - 1;
  const double refit = facts.torque.refit - 1;
  if (facts.effects) {
    const bool held_out_left =
        after > Limits().left && after > Limits().left * refit;
    return much_left || held_out_left ? GapVerdict::kPartlyExplained
                                      : GapVerdict::kExplained;
  }
  // Nor is what was fitted without a name missing from a file that predicts
  // what was held out to the noise.
  const bool found = facts.found_without_name && nominal > 0;
  if (much_left || found || IsLoudHeldOut(facts)) return GapVerdict::kUnknown;
  return nominal > Limits().left && refit < Limits().absorbed * nominal
             ? GapVerdict::kAbsorbed
             : GapVerdict::kNoiseFloor;
}

const char* GapVerdictName(GapVerdict verdict) {
  switch (verdict) {
    case GapVerdict::kNoiseFloor:
      return "noise_floor";
    case GapVerdict::kAbsorbed:
      return "absorbed";
    case GapVerdict::kExplained:
      return "explained";
    case GapVerdict::kPartlyExplained:
      return "partly_explained";
    case GapVerdict::kUnknown:
      return "unknown";
    case GapVerdict::kNotTestable:
      return "not_testable";
  }
  return "";
}

}  // namespace armcal
