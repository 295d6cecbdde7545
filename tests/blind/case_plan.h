#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/plant/hidden/hidden_effects.h"

namespace armcal {

enum class Excitation {
  kRich,      // all joints, most of their range and speed
  kSlow,      // all joints at a sixth of their speed
  kSmall,     // all joints, a fifth of their range
  kTwoJoints  // the others stand still
};
const char* ExcitationName(Excitation excitation);

// What cases are for; scores are counted by stratum.
enum class Stratum {
  kNoneRich,  // no effect, rich excitation
  kNonePoor,  // no effect, any other excitation
  kOne,       // one effect of the catalogue
  kTwo,       // two of them
  kOutside    // one that is not in the catalogue
};
// "none_rich", "none_poor", "one", "two", "outside".
const char* StratumName(Stratum stratum);
// Nothing where there is none of that name.
std::optional<Stratum> StratumOf(const std::string& name);
inline constexpr int kNumStrata = 5;

// Sizes of effects relative to the noise (EffectSize::enr) within which scores
// are counted: bin k reaches from kEnrBins[k] to kEnrBins[k + 1], the last one
// to infinity.
inline constexpr double kEnrBins[] = {0, .17, .32, 1, 3};
inline constexpr int kNumEnrBins = 5;
int EnrBin(double enr);

struct CasePlan {
  Stratum stratum = Stratum::kNoneRich;
  Excitation excitation = Excitation::kRich;
  // Of the first effect: nullptr where there is none.
  const HiddenEffect* effect = nullptr;
  // The bins to draw its ENR from, from the first to the last of them.
  int lowest_bin = 2, highest_bin = 4;

  // Their ends.
  double least_enr() const;
  double most_enr() const;
};

// The plan of a case of the bench: strata as in the table of case_plan.cc, in
// an order in which every stretch has its share of each. What case 7 is does
// not depend on how many are drawn.
CasePlan PlanCase(uint32_t index);
// Case `k` of one stratum.
CasePlan PlanCase(Stratum stratum, uint32_t k);
// Case `k` of those of one effect of the catalogue, as stratum kOne has them.
CasePlan PlanCase(const HiddenEffect& effect, uint32_t k);
// How many cases the evaluation has.
uint32_t EvaluationCases();

}  // namespace armcal
