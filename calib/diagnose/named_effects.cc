#include "calib/diagnose/named_effects.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/names.h"
#include "model/text/enumeration.h"
#include "model/text/format.h"

namespace armcal {
namespace {

// What a probability is worth in words: one of three, as it falls.
const char* InWords(double probability, const char* sure, const char* likely,
                    const char* possible) {
  if (IsConfident(probability)) return sure;
  return probability > Limits().likely ? likely : possible;
}

const char* Lacks(double least_probability) {
  return InWords(least_probability, "lacks", "probably lacks", "may lack");
}

// The same of changes since a reference, up to their list.
std::string Changed(double least_probability, const GapDiagnosis& diagnosis) {
  return InWords(least_probability, "Changed", "Probably changed",
                 "May have changed") +
         (" since " + SinceWhat(diagnosis)) + ": ";
}

// "Something probably touched the arm 2 times"
std::string Touched(double probability, size_t times) {
  return std::string("Something ") +
         InWords(probability, "touched", "probably touched",
                 "may have touched") +
         " the arm " + (times == 1 ? "once" : std::to_string(times) + " times");
}

// Effects in a sentence, and how certain the least certain is.
struct Named {
  std::vector<std::string> names;
  double least = 1;
  std::vector<std::string> untold;  // of them: by the reference
  bool would_show = false;          // one of them, on held-out data

  void Add(const FoundEffect& found, const GapDiagnosis& diagnosis) {
    would_show |= found.gain.IsNone();
    names.push_back(diagnosis.has_reference || IsTakenOff(found)
                        ? ChangeOf(found, diagnosis)
                        : NameOf(found, diagnosis));
    if (IsUntoldByReference(found, diagnosis)) {
      untold.push_back(NameOf(*found.effect, found.joint, diagnosis));
    }
    least = std::min(least, found.probability);
  }
  // " lacks payload, delay and backlash on elbow"
  std::string Lacked(const char* also) const {
    return std::string(" ") + also + Lacks(least) + " " + Enumeration(names);
  }
};

// " lacks viscous friction; refitted with it, 80 % of the file's gap is gone"
std::string TermsLacked(const Named& terms, double less) {
  const std::string text = terms.Lacked("");
  if (!(less >= .5)) return text;
  return text + Format(
                    "; refitted with %s, %.0f %% of the file's gap is gone "
                    "on held-out data",
                    terms.names.size() > 1 ? "them" : "it", less);
}

// An effect that is a small part of the gap shrinks it by less than the rest
// swings: that is no sign against it, where one that would shrink it is.
std::string Removes(const Named& effects, double removed) {
  if (!std::isfinite(removed)) return "";
  if (removed < .5) {
    return effects.would_show
               ? ", which does not shrink the gap on held-out data"
               : ", too small a part of the gap for held-out data to show";
  }
  return Format(
      ", which removes %.0f %% of the gap that refitting leaves on held-out "
      "data",
      removed);
}

// "; the reference does not tell whether it had torque ripple on elbow before"
std::string Untold(const Named& effects, const GapDiagnosis& diagnosis) {
  if (effects.untold.empty()) return "";
  return "; " + SinceWhat(diagnosis) + " does not tell whether the robot had " +
         Enumeration(effects.untold) + " before";
}

// "one of payload, base tilt and encoder offset on elbow"
std::string OneOf(const FoundEffect& found, const GapDiagnosis& diagnosis) {
  std::vector<std::string> names = {
      NameOf(*found.effect, found.joint, diagnosis)};
  for (const PlacedEffect& other : found.equivalent) {
    names.push_back(NameOf(*other.effect, other.joint, diagnosis));
  }
  return "one of " + Enumeration(names);
}

// What has several names, and how certain the least certain is.
struct Alike {
  std::string names;
  double least = 1;
};

Alike AlikeOf(const GapDiagnosis& diagnosis) {
  Alike alike;
  for (const FoundEffect& found : diagnosis.unnamed) {
    if (!found.one_of_few) continue;
    alike.names +=
        (alike.names.empty() ? "" : ", and ") + OneOf(found, diagnosis);
    alike.least = std::min(alike.least, found.any_probability);
  }
  return alike;
}

}  // namespace

std::string NamedEffects(const GapDiagnosis& diagnosis) {
  std::string touched;
  Named terms, effects;
  for (const FoundEffect& found : diagnosis.effects) {
    // ChangedTogether() and the data's findings say so.
    if (found.of_another_day || found.of_the_stamps) continue;
    if (!found.contacts.empty()) {
      touched = Touched(found.probability, found.contacts.size());
    } else {
      const bool is_term = found.fitted.empty() && !diagnosis.has_reference;
      (is_term ? terms : effects).Add(found, diagnosis);
    }
  }
  const GapFigures& gap = diagnosis.torque;
  const std::string removes = Removes(effects, gap.removed_percent);
  if (terms.names.empty() && effects.names.empty()) return touched;
  if (diagnosis.has_reference) {
    return touched + (touched.empty() ? "" : ". ") +
           Changed(effects.least, diagnosis) + Enumeration(effects.names) +
           removes + Untold(effects, diagnosis);
  }
  const std::string model = touched.empty() ? "The model" : "; the model";
  if (terms.names.empty()) {
    return touched + model + effects.Lacked("") + removes;
  }
  if (effects.names.empty()) {
    return touched + model +
           TermsLacked(terms, gap.removed_from_nominal_percent);
  }
  return touched + model + TermsLacked(terms, gap.refit_removes_percent) +
         "; it" + effects.Lacked("also ") + removes;
}

std::string AlikeEffects(const GapDiagnosis& diagnosis) {
  const Alike alike = AlikeOf(diagnosis);
  if (alike.names.empty()) return "";
  if (diagnosis.has_reference) {
    return Changed(alike.least, diagnosis) + alike.names +
           "; these data cannot tell which.";
  }
  return std::string("The model ") + Lacks(alike.least) + " " + alike.names +
         ": these data cannot tell which.";
}

std::string AlikeBesides(const GapDiagnosis& diagnosis) {
  const Alike alike = AlikeOf(diagnosis);
  if (alike.names.empty()) return "";
  const std::string changed =
      InWords(alike.least, " has changed", " has probably changed",
              " may have changed");
  return " Besides, " +
         (diagnosis.has_reference
              ? alike.names + changed
              : std::string("the model ") + Lacks(alike.least) + " " +
                    alike.names) +
         ": these data cannot tell which.";
}

}  // namespace armcal
