#include "calib/diagnose/impossible_terms.h"

#include <string>

#include "calib/diagnose/data/thresholds.h"
#include "model/text/enumeration.h"
#include "model/text/format.h"

namespace armcal {
namespace {

bool IsOf(const FoundEffect& found, const MovedParameter& one) {
  return one.term && found.effect->joint_term == one.term;
}

}  // namespace

std::vector<DataFinding> TellImpossibleTerms(
    const std::vector<FoundEffect>& effects,
    const std::vector<MovedParameter>& moved) {
  const double beyond_doubt = Limits().clear_of_many;
  std::vector<DataFinding> findings;
  for (const FoundEffect& found : effects) {
    if (!found.fitted.empty() || found.effect->joint_term == JointTerm::kOffset)
      continue;
    std::vector<std::string> below;
    bool any_above = false;
    for (const MovedParameter& one : moved) {
      if (!IsOf(found, one)) continue;
      any_above |= one.value > beyond_doubt * one.stddev;
      if (!(one.value < -beyond_doubt * one.stddev)) continue;
      below.push_back(one.name +
                      Format(" (%.3g +- %.2g ", one.value, one.stddev) +
                      one.unit + ")");
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
