#include "calib/diagnose/sentence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/diagnose/data/thresholds.h"
#include "model/text/enumeration.h"
#include "model/text/format.h"

namespace armcal {
namespace {

// What probabilities of effects are worth in words.
const char* Lacks(double least_probability) {
  if (IsConfident(least_probability)) return "lacks";
  return least_probability > Limits().likely ? "probably lacks" : "may lack";
}

// Effects in a sentence, and how certain the least certain is.
struct Named {
  std::vector<std::string> names;
  double least = 1;
  bool would_show = false;  // one of them, on held-out data

  void Add(const FoundEffect& found, const GapDiagnosis& diagnosis) {
    would_show |= found.gain.IsNone();
    names.push_back(NameOf(*found.effect, found.joint, diagnosis));
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
std::string EffectsLacked(const Named& effects, bool besides, double removed) {
  const std::string text = effects.Lacked(besides ? "also " : "");
  if (!std::isfinite(removed)) return text;
  if (removed < .5) {
    return text + (effects.would_show
                       ? ", which does not shrink the gap on held-out data"
                       : ", too small a part of the gap for held-out data to "
                         "show");
  }
  return text + Format(
                    ", which removes %.0f %% of the gap that refitting "
                    "leaves on held-out data",
                    removed);
}

// What happened, and what the model lacks: joints' terms that the file has for
// none, which the refit has as well, and then what a refit cannot have.
std::string Findings(const GapDiagnosis& diagnosis) {
  std::string touched;
  Named terms, effects;
  for (const FoundEffect& found : diagnosis.effects) {
    // ChangedTogether() and the data's findings say so.
    if (found.of_another_day || found.of_the_stamps) continue;
    const size_t times = found.contacts.size();
    if (times > 0) {
      touched = "Something touched the arm " +
                (times == 1 ? "once" : std::to_string(times) + " times");
    } else {
      (found.fitted.empty() ? terms : effects).Add(found, diagnosis);
    }
  }
  const std::string model = touched.empty() ? "The model" : "; the model";
  const GapFigures& gap = diagnosis.torque;
  if (terms.names.empty() && effects.names.empty()) return touched;
  if (terms.names.empty()) {
    return touched + model + EffectsLacked(effects, false, gap.removed_percent);
  }
  if (effects.names.empty()) {
    return touched + model +
           TermsLacked(terms, gap.removed_from_nominal_percent);
  }
  return touched + model + TermsLacked(terms, gap.refit_removes_percent) +
         "; it" + EffectsLacked(effects, true, gap.removed_percent);
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

// What has several names, none of which is probable enough; empty where nothing
// has.
std::string NamesAlike(const GapDiagnosis& diagnosis) {
  std::string names;
  double least = 1;
  for (const FoundEffect& found : diagnosis.unnamed) {
    if (!found.one_of_few) continue;
    names += (names.empty() ? "" : ", and ") + OneOf(found, diagnosis);
    least = std::min(least, found.any_probability);
  }
  if (names.empty()) return "";
  return std::string("The model ") + Lacks(least) + " " + names +
         ": these data cannot tell which.";
}

bool IsMovedZero(const MovedParameter& moved) {
  return moved.term == JointTerm::kOffset;
}

bool AnyZeroMoved(const GapDiagnosis& diagnosis) {
  return !SinceWhat(diagnosis).empty() &&
         std::any_of(diagnosis.moved.begin(), diagnosis.moved.end(),
                     IsMovedZero);
}

// "elbow.viscous -20 %"; a zero has no size of which that could be a share.
std::string Change(const MovedParameter& moved, bool is_zero) {
  const double change = moved.value - moved.nominal;
  return moved.name + (is_zero || moved.nominal == 0
                           ? Format(" %+.2g %s", change, moved.unit.c_str())
                           : Format(" %+.0f %%", 100 * change / moved.nominal));
}

// What differs on several joints is one change, as temperature makes it of
// friction and time of torques' zeros: "Friction has changed since the
// reference: elbow.viscous -20 %. " Empty where nothing has.
std::string ChangedTogether(const GapDiagnosis& diagnosis) {
  const std::string before = SinceWhat(diagnosis);
  if (before.empty()) return "";
  std::string text;
  for (const bool zeros : {false, true}) {
    std::string list;
    for (const MovedParameter& moved : diagnosis.moved) {
      if (IsMovedZero(moved) != zeros) continue;
      list += (list.empty() ? "" : ", ") + Change(moved, zeros);
    }
    if (list.empty()) continue;
    text += (zeros ? "Torques' zeros have moved since " + before
                   : "Friction has changed since " + before) +
            ": " + list + ". ";
  }
  return text;
}

double NoiseShare(const JointGap& joint) {
  return joint.torque_rms > 0 ? joint.floor_rms / joint.torque_rms : 0;
}

// Where nothing tells the noise it is what a refit leaves. If that is more than
// what it explains of the joints' torques, in the mean of their squares, a
// model that leaves no more than it is not confirmed by that.
bool ExplainsLessThanItLeaves(const GapDiagnosis& diagnosis) {
  double squares = 0;
  for (const JointGap& joint : diagnosis.joints) {
    squares += NoiseShare(joint) * NoiseShare(joint);
  }
  return diagnosis.floor == NoiseFloor::kAssumed &&
         squares > .5 * static_cast<double>(diagnosis.joints.size());
}

// To agree within noise means as little as there is much of it: its largest
// share of a joint's recorded torque, rms over rms.
std::string Agreement(const GapDiagnosis& diagnosis) {
  const std::string agrees =
      "The model agrees with the log to within the noise";
  double most = 0;
  std::string joint;
  for (const JointGap& gap : diagnosis.joints) {
    if (NoiseShare(gap) <= most) continue;
    most = NoiseShare(gap);
    joint = gap.name;
  }
  if (joint.empty()) return agrees + ".";
  if (most < 1) {
    return agrees + Format(", up to %.2g %% of the torque (%s).", 100 * most,
                           joint.c_str());
  }
  return agrees + ", which is as large as the torque of " + joint +
         ": that tells nothing of it.";
}

// What is there without a name: one of a few known effects, or none of them.
std::string WithoutName(const GapDiagnosis& diagnosis) {
  const std::string alike = NamesAlike(diagnosis);
  if (!alike.empty()) return alike;
  std::string text = "Something real is missing that no known effect explains";
  const auto& unexplained = diagnosis.unexplained;
  if (!unexplained.joint.empty()) {
    text += ": most of it on " + unexplained.joint;
    if (!unexplained.organised_by.empty()) {
      text += ", ordered by its " + unexplained.organised_by;
    }
  }
  return text + ".";
}

// A mean square in units of the noise's: it is the noise where two digits say
// so.
std::string OfNoise(double mean_square) {
  if (!(mean_square >= 1.05)) return "the noise";
  return Format("%.2g times the noise's mean square", mean_square);
}

// What is left given what has changed together.
std::string BriefVerdict(const GapDiagnosis& diagnosis) {
  constexpr double kNoisy = 2;  // times the noise's mean square
  const bool nothing_named = diagnosis.verdict == GapVerdict::kNoiseFloor ||
                             diagnosis.verdict == GapVerdict::kAbsorbed;
  if (nothing_named && diagnosis.torque.refit > kNoisy) {
    return Format(
        "No known effect is seen, yet held-out torque is off by %.3g times the "
        "noise's mean square: the noise may be louder than was told, or "
        "something is missing that the fitted logs do not show.",
        diagnosis.torque.refit);
  }
  if (nothing_named && ExplainsLessThanItLeaves(diagnosis)) {
    return "The model explains less of the torque than it leaves, which is "
           "taken for noise here: these data tell nothing of it. Is the torque "
           "this arm's, and of this motion?";
  }
  switch (diagnosis.verdict) {
    case GapVerdict::kNoiseFloor:
      return Agreement(diagnosis);
    case GapVerdict::kAbsorbed:
      return AnyZeroMoved(diagnosis)
                 ? "Nothing but these, friction and timing has changed."
             : diagnosis.has_reference
                 ? "Nothing but friction and timing has changed since " +
                       SinceWhat(diagnosis) + "."
                 : "Nothing is missing in the model but better values: "
                   "refitting its parameters brings it down to " +
                       OfNoise(diagnosis.torque.refit) + ".";
    case GapVerdict::kExplained:
      return Findings(diagnosis) + ".";
    case GapVerdict::kPartlyExplained:
      return Findings(diagnosis) + "; something else is left.";
    case GapVerdict::kUnknown:
      return WithoutName(diagnosis);
    case GapVerdict::kNotTestable:
      return "These data cannot carry a diagnosis.";
  }
  return "";
}

}  // namespace

std::string NameOf(const Effect& effect, int joint,
                   const GapDiagnosis& diagnosis) {
  std::string text = effect.name;
  for (char& c : text) {
    if (c == '_') c = ' ';
  }
  if (joint >= 0) text += " on " + diagnosis.joints[joint].name;
  return text;
}

bool IsConfident(double probability) { return probability >= .8; }

std::string SinceWhat(const GapDiagnosis& diagnosis) {
  const bool is_calibrations = diagnosis.calibrations_logs ==
                               GapDiagnosis::CalibrationsLogs::kAreTheReference;
  if (diagnosis.has_reference && !is_calibrations) return "the reference";
  return diagnosis.has_calibration ? "the calibration" : "";
}

std::string BriefReport(const GapDiagnosis& diagnosis) {
  std::string text;
  for (const DataFinding& finding : diagnosis.data) {
    if (finding.leads) text += "First: " + finding.finding + ". ";
  }
  return text + ChangedTogether(diagnosis) + BriefVerdict(diagnosis);
}

}  // namespace armcal
