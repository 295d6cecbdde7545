#include "calib/diagnose/sentence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/diagnose/named_effects.h"
#include "calib/diagnose/names.h"
#include "model/text/format.h"

namespace armcal {
namespace {

bool IsMovedZero(const MovedParameter& moved) {
  return moved.term == JointTerm::kOffset;
}

bool AnyZeroMoved(const GapDiagnosis& diagnosis) {
  return !SinceWhat(diagnosis).empty() &&
         std::any_of(diagnosis.moved.begin(), diagnosis.moved.end(),
                     IsMovedZero);
}

// "elbow.viscous -20 %"; a zero has no size of which that could be a share. Of
// what was nothing before a share says nothing, and of friction below zero, as
// a reference may have it where other laws share its joint, it has the wrong
// sign.
std::string Change(const MovedParameter& moved, bool is_zero) {
  constexpr double kOfNothing = 10;
  const double change = moved.value - moved.nominal;
  const bool was_nothing = std::abs(change) > kOfNothing * moved.nominal;
  return moved.name + (is_zero || was_nothing
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
// share of a joint's recorded torque, rms over rms. Noise that nothing tells
// but what a refit leaves holds what the model lacks as well, and is called so.
std::string Agreement(const GapDiagnosis& diagnosis) {
  const bool is_assumed = diagnosis.floor == NoiseFloor::kAssumed;
  const std::string agrees =
      std::string("The model agrees with the log to within ") +
      (is_assumed ? "what a refit leaves, which is taken for noise"
                  : "the noise");
  double most = 0;
  std::string joint;
  for (const JointGap& gap : diagnosis.joints) {
    if (NoiseShare(gap) <= most) continue;
    most = NoiseShare(gap);
    joint = gap.name;
  }
  if (joint.empty()) return agrees + ".";
  if (most < 1) {
    return agrees + (is_assumed ? " and is" : ", which is") +
           Format(" up to %.2g %% of the torque of %s.", 100 * most,
                  joint.c_str());
  }
  return agrees + ", which is as large as the torque of " + joint +
         ": that tells nothing of it.";
}

// A mean square in units of the noise's: it is the noise where two digits say
// so.
constexpr double kAboveNoise = 1.05;
std::string OfNoise(double mean_square) {
  if (!(mean_square >= kAboveNoise)) return "the noise";
  return Format("%.2g times the noise's mean square", mean_square);
}

// ": most of it on elbow, ordered by its speed"; empty where it is on no joint.
std::string Where(const Unexplained& unexplained) {
  if (unexplained.joint.empty()) return "";
  const std::string& by = unexplained.organised_by;
  return ": most of it on " + unexplained.joint +
         (by.empty() ? "" : ", ordered by its " + by);
}

// With a reference the question was what has changed. What is left is more than
// what the model leaves of the reference as it was fitted; whether that is a
// change is seen on held-out data. Even there it need not be one: another
// motion shows what the reference's did not.
std::string ChangedWithoutName(const GapDiagnosis& diagnosis) {
  const bool besides = !ChangedTogether(diagnosis).empty();
  const std::string since = " since " + SinceWhat(diagnosis);
  const std::string where = Where(diagnosis.unexplained);
  if (diagnosis.torque.after < LoudestNoise()) {
    return (besides ? "No other change" : "No change") + since +
           " can be named; what is left of held-out torque is " +
           OfNoise(diagnosis.torque.after) + where + ".";
  }
  return std::string("Something ") + (besides ? "else " : "") + "has changed" +
         since +
         " that no known effect explains, or shows in this motion alone" +
         where + ".";
}

// What is there without a name: one of a few known effects, or none of them.
std::string WithoutName(const GapDiagnosis& diagnosis) {
  const std::string alike = AlikeEffects(diagnosis);
  if (!alike.empty()) return alike;
  if (diagnosis.has_reference) return ChangedWithoutName(diagnosis);
  return "Something real is missing that no known effect explains" +
         Where(diagnosis.unexplained) + ".";
}

// Refitting explains what differs from a reference. It has friction of the day,
// links and timing to do so, any of which may stand for a change of another
// kind: a joint whose encoder is off by a degree was seen to be refitted as one
// with other friction. So that nothing else has changed is never said.
std::string AbsorbedSince(const GapDiagnosis& diagnosis) {
  const std::string since = " since " + SinceWhat(diagnosis);
  const bool besides = !ChangedTogether(diagnosis).empty();
  const GapFigures& gap = diagnosis.torque;
  // "from 26 to 1.4 times the noise's mean square"
  const std::string refit =
      "refitting the model's numbers (friction, links, timing) brings "
      "what is left of held-out torque from " +
      Format("%.3g ", gap.nominal) +
      (gap.refit >= kAboveNoise ? "" : "times the noise's mean square ") +
      "to " + OfNoise(gap.refit);
  return besides ? "Nothing else is named: " + refit +
                       "; a change that is like these may hide in that."
                 : "No change" + since + " is named, yet " + refit +
                       ": something has changed, or shows in this motion "
                       "alone.";
}

// Effects that remove most of the gap may leave much more than noise:
// "; 16 times the noise's mean square is left".
std::string StillLeft(const GapDiagnosis& diagnosis) {
  if (!(diagnosis.torque.after >= LoudestNoise())) return "";
  return "; " + OfNoise(diagnosis.torque.after) + " is left";
}

// What is left given what has changed together.
std::string BriefVerdict(const GapDiagnosis& diagnosis) {
  const bool nothing_named = diagnosis.verdict == GapVerdict::kNoiseFloor ||
                             diagnosis.verdict == GapVerdict::kAbsorbed;
  if (diagnosis.only_held_out_left) {
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
      if (diagnosis.has_reference || AnyZeroMoved(diagnosis)) {
        return AbsorbedSince(diagnosis);
      }
      return "Nothing is missing in the model but better values: refitting its "
             "parameters brings it down to " +
             OfNoise(diagnosis.torque.refit) + ".";
    case GapVerdict::kExplained:
      return NamedEffects(diagnosis) + StillLeft(diagnosis) + "." +
             AlikeBesides(diagnosis);
    case GapVerdict::kPartlyExplained:
      return NamedEffects(diagnosis) + "; something else is left." +
             AlikeBesides(diagnosis);
    case GapVerdict::kUnknown:
      return WithoutName(diagnosis);
    case GapVerdict::kNotTestable:
      return "These data cannot carry a diagnosis.";
  }
  return "";
}

}  // namespace

std::string BriefReport(const GapDiagnosis& diagnosis) {
  std::string text;
  for (const DataFinding& finding : diagnosis.data) {
    if (finding.leads) text += "First: " + finding.finding + ". ";
  }
  return text + ChangedTogether(diagnosis) + BriefVerdict(diagnosis);
}

}  // namespace armcal
