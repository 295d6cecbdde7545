#include <algorithm>

#include "calib/poses/diagnosis/report.h"
#include "model/text/enumeration.h"
#include "model/text/format.h"

namespace armcal {
namespace {

std::string MillimetresOf(double x) { return Format("%.3g mm", 1e3 * x); }

// What a probability is worth in words, as in the sentence on logs
// (diagnose/named_effects.h).
const char* InWords(double probability) {
  constexpr double kConfident = .8;
  return probability >= kConfident ? "lacks " : "probably lacks ";
}

// "one of sag of elbow and gear_ratio of elbow"
std::string OneOf(const PoseFinding& finding) {
  std::vector<std::string> names = {finding.name};
  for (const PoseEquivalent& other : finding.equivalents) {
    names.push_back(other.name);
  }
  return names.size() > 1 ? "one of " + Enumeration(names)
                          : finding.name + " or another effect";
}

// "lacks sag of elbow; it probably lacks one of .., which these poses cannot
// tell apart"
std::string LackedText(const std::vector<PoseFinding>& findings) {
  std::vector<std::string> named, alike;
  double least = 1, least_alike = 1;
  for (const PoseFinding& finding : findings) {
    if (IsNamed(finding)) {
      named.push_back(finding.name);
      least = std::min(least, finding.probability);
    } else {
      alike.push_back(OneOf(finding));
      least_alike = std::min(least_alike, 1 - finding.none);
    }
  }
  std::string text;
  if (!named.empty()) text = InWords(least) + Enumeration(named);
  if (alike.empty()) return text;
  return text + (text.empty() ? "" : "; it ") + InWords(least_alike) +
         Enumeration(alike) + ", which these poses cannot tell apart";
}

// The likeliest of what is not claimed, beside none.
std::string UnlikelyText(const PoseDiagnosis& diagnosis) {
  if (diagnosis.unlikely.empty()) return "";
  const auto best = std::max_element(
      diagnosis.unlikely.begin(), diagnosis.unlikely.end(),
      [](const auto& a, const auto& b) { return a.none > b.none; });
  return Format(" None is likelier (%.0f %%) than ", 100 * best->none) +
         best->name + Format(" (%.0f %%).", 100 * best->probability);
}

}  // namespace

std::string PoseSentence(const PoseDiagnosis& diagnosis) {
  if (diagnosis.verdict == PoseVerdict::kNotTestable) {
    return "Not testable: " + diagnosis.reason + ".";
  }
  const PoseGap& gap = diagnosis.gap;
  const std::string left = MillimetresOf(gap.held_out_after);
  switch (diagnosis.verdict) {
    case PoseVerdict::kNoiseFloor:
      return "The poses show no effect beyond the geometry, which leaves " +
             left + " of held-out poses." + UnlikelyText(diagnosis);
    case PoseVerdict::kUnknown:
      return "The geometry leaves " + left +
             " of held-out poses, which is more than noise, and no effect of "
             "the list explains it." +
             UnlikelyText(diagnosis);
    default:
      break;
  }
  return "The geometry " + LackedText(diagnosis.findings) +
         ": held-out poses are " + left + " rms away instead of " +
         MillimetresOf(gap.held_out_geometry) +
         (diagnosis.verdict == PoseVerdict::kPartlyExplained
              ? ", which is still more than noise."
              : ".");
}

}  // namespace armcal
