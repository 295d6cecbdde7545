#include <algorithm>
#include <cmath>

#include "calib/poses/diagnosis/report.h"
#include "model/text/enumeration.h"
#include "model/text/format.h"

namespace armcal {
namespace {

std::string MillimetresOf(double x) { return Format("%.3g mm", 1e3 * x); }

// Names with by how much each moves the targets, which tells what matters:
// "sag (3.41 mm rms)"; from 80 % on they are told without a "probably", as in a
// sentence on logs (IsConfident in diagnose/names.h).
struct Claims {
  void Add(const PoseFinding& finding) {
    constexpr double kConfident = .8;
    (finding.probability >= kConfident ? sure : unsure)
        .push_back(
            finding.name +
            (CountsTheOtherWay(finding) ? ", which counts the other way" : "") +
            " (" + MillimetresOf(finding.displacement_rms) + " rms)");
  }
  bool empty() const { return sure.empty() && unsure.empty(); }
  // "lacks a and probably b", "probably lacks a and b".
  std::string After(const std::string& verb) const {
    if (sure.empty()) return "probably " + verb + Enumeration(unsure);
    std::vector<std::string> all = sure;
    for (const std::string& name : unsure) all.push_back("probably " + name);
    return verb + Enumeration(all);
  }
  std::vector<std::string> sure, unsure;
};

// "one of joint_step of wrist (40 %), joint_drift of wrist (35 %) and others"
std::string OneOf(const PoseFinding& finding) {
  const auto with_chance = [](const std::string& name, double probability) {
    return name + Format(" (%.0f %%)", 100 * probability);
  };
  std::vector<std::string> names = {
      with_chance(finding.name, finding.probability)};
  for (const PoseEquivalent& other : finding.equivalents) {
    names.push_back(with_chance(other.name, other.probability));
  }
  if (names.size() == 1) names.emplace_back("another effect");
  return "one of " + Enumeration(names);
}

// What the arm does at any time, what changed while it was measured, and where
// the poses leave open which of a few it is: a sentence each. Where something
// changed in the latter case is among its names.
std::string FoundText(const std::vector<PoseFinding>& findings) {
  Claims lacked, changed;
  std::vector<std::string> open;
  for (const PoseFinding& finding : findings) {
    if (!IsNamed(finding)) {
      open.push_back(OneOf(finding));
    } else {
      (finding.placed.effect->in_order ? changed : lacked).Add(finding);
    }
  }
  std::string text;
  if (!lacked.empty()) text += "The geometry " + lacked.After("lacks ") + ". ";
  if (!changed.empty()) {
    text += "While the poses were measured something " +
            changed.After("changed: ") + ". ";
  }
  for (const std::string& few : open) {
    text += "These poses cannot tell which, but they show " + few + ". ";
  }
  return text;
}

// The likeliest of what is not claimed, beside none.
std::string UnlikelyText(const PoseDiagnosis& diagnosis) {
  if (diagnosis.unlikely.empty()) return "";
  const auto best = std::max_element(
      diagnosis.unlikely.begin(), diagnosis.unlikely.end(),
      [](const auto& a, const auto& b) { return a.none > b.none; });
  return " The likeliest, " + best->name +
         Format(" (%.0f %%), is less likely than none (%.0f %%).",
                100 * best->probability, 100 * best->none);
}

}  // namespace

bool CountsTheOtherWay(const PoseFinding& finding) {
  const double at = finding.placed.effect->turned_round_at;
  if (at == 0 || finding.amounts.empty()) return false;
  const PoseAmount& amount = finding.amounts[0];
  return std::abs(amount.value - at) <= amount.half_width;
}

std::string PoseSentence(const PoseDiagnosis& diagnosis) {
  if (diagnosis.verdict == PoseVerdict::kNotTestable) {
    return "Not testable: " + diagnosis.reason + ".";
  }
  const PoseGap& gap = diagnosis.gap;
  const std::string left = MillimetresOf(gap.held_out_after);
  switch (diagnosis.verdict) {
    case PoseVerdict::kNoiseFloor:
      return "The poses show no effect beyond the geometry, by which held-out "
             "poses are " +
             left + " rms away" +
             (diagnosis.misfit.instrument_u95 > 0
                  ? "."
                  : "; the file states no uncertainty of the instrument "
                    "(u95_1) to hold that against.") +
             UnlikelyText(diagnosis);
    case PoseVerdict::kUnknown:
      return "By the geometry held-out poses are " + left +
             " rms away, which is more than noise, and no effect of the list "
             "explains it." +
             UnlikelyText(diagnosis);
    default:
      break;
  }
  return FoundText(diagnosis.findings) + "Held-out poses are then " + left +
         " rms away instead of " + MillimetresOf(gap.held_out_geometry) +
         (diagnosis.verdict == PoseVerdict::kPartlyExplained
              ? ", which is still more than noise."
              : ".");
}

}  // namespace armcal
