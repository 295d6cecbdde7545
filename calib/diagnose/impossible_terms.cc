#include "calib/diagnose/impossible_terms.h"

#include <string>

#include "model/text/enumeration.h"
#include "model/text/format.h"

namespace armcal {
namespace {

// Standard deviations: one in thirty thousand by chance, and what the model
// lacks may be as much again.
constexpr double kBeyondDoubt = 4;

bool IsOf(const FoundEffect& found, const MovedParameter& moved) {
  return moved.term && found.effect->joint_term == moved.term;
}

}  // namespace

std::vector<DataFinding> TellImpossibleTerms(const GapDiagnosis& diagnosis) {
  std::vector<DataFinding> findings;
  if (diagnosis.has_reference) return findings;
  for (const FoundEffect& found : diagnosis.effects) {
    if (!found.fitted.empty() || found.effect->joint_term == JointTerm::kOffset)
      continue;
    std::vector<std::string> below;
    bool any_above = false;
    for (const MovedParameter& moved : diagnosis.moved) {
      if (!IsOf(found, moved)) continue;
      any_above |= moved.value > kBeyondDoubt * moved.stddev;
      if (!(moved.value < -kBeyondDoubt * moved.stddev)) continue;
      below.push_back(moved.name +
                      Format(" (%.3g +- %.2g ", moved.value, moved.stddev) +
                      moved.unit + ")");
    }
    if (below.empty() || any_above) continue;
    findings.push_back(
        {Enumeration(below) + (below.size() > 1 ? " are" : " is") +
             " below zero, which no joint has",
         "torques, or positions and velocities, that have the wrong sign are "
         "fitted so",
         "armcal inspect", true});
  }
  return findings;
}

}  // namespace armcal
