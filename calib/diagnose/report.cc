#include "calib/diagnose/report.h"

#include <cmath>
#include <set>

#include "model/log_files/torque_columns.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// "payload", "stribeck on elbow".
std::string Named(const Effect& effect, int joint,
                  const GapDiagnosis& diagnosis) {
  std::string text = effect.name;
  for (char& c : text) {
    if (c == '_') c = ' ';
  }
  if (joint >= 0) text += " on " + diagnosis.joints[joint].name;
  return text;
}

// What nothing tells of is as it was: at 0, without a deviation. Numbers that
// are chosen, not fitted, have none either.
std::string ValueText(double value, double stddev) {
  if (stddev > 0) return Format("%.3g +- %.1g", value, stddev);
  return value == 0 ? "not seen" : Format("%.3g", value);
}

// Of a FoundEffect or a ShownEffect.
template <typename Found>
std::string Estimates(const Found& found) {
  std::string text;
  for (size_t k = 0; k < found.estimates.size(); ++k) {
    const EffectEstimate& estimate = found.estimates[k];
    const bool unit =
        estimate.unit != "1" && (estimate.value != 0 || found.stddev[k] > 0);
    text += (k ? ", " : "") + estimate.name + " " +
            ValueText(estimate.value, found.stddev[k]) +
            (unit ? " " + estimate.unit : "");
  }
  return text;
}

std::string EffectLines(const FoundEffect& found,
                        const GapDiagnosis& diagnosis) {
  std::string text = Format("  %3.0f %%  ", 100 * found.probability) +
                     Named(*found.effect, found.joint, diagnosis) + ": " +
                     Estimates(found) + "\n";
  for (const Contact& contact : found.contacts) {
    const JointGap& joint = diagnosis.joints[contact.joint];
    text +=
        Format("         %.1f to %.1f s: %.3g +- %.1g ", contact.window.begin,
               contact.window.end, contact.torque[contact.joint],
               contact.stddev[contact.joint]) +
        joint.unit + " on " + joint.name + "\n";
  }
  constexpr double kWorthSaying = .02;
  for (const PlacedEffect& other : found.equivalent) {
    if (other.probability < kWorthSaying) continue;
    text += Format("         or %.0f %% ", 100 * other.probability) +
            Named(*other.effect, other.joint, diagnosis) + "\n";
  }
  if (!found.separate_by.empty()) {
    text += "         told apart by: " + found.separate_by + "\n";
  }
  return text;
}

// What the data ask for as well, but no name is probable enough for: no part of
// any figure here.
std::string Unnamed(const GapDiagnosis& diagnosis) {
  std::string text = diagnosis.unnamed.empty() ? "" : "\nfitted, not named\n";
  for (const FoundEffect& found : diagnosis.unnamed) {
    text += Format("  %3.0f %%  ", 100 * found.probability) +
            Named(*found.effect, found.joint, diagnosis);
    if (found.removed_percent > 0) {
      text += Format(": would remove %.0f %% of what refitting leaves",
                     found.removed_percent);
    } else if (std::isfinite(found.removed_percent)) {
      text += ": held out, it removes nothing";
    }
    text += "\n";
  }
  return text;
}

// What was not held out has no figure, and no loop that runs away.
std::string FigureText(double x) {
  if (std::isnan(x)) return "-";
  return std::isinf(x) ? "diverges" : Format("%.3g", x);
}

std::string WhereTable(const GapDiagnosis& diagnosis) {
  std::string text =
      "\nheld-out torque, rms        nominal      refit      after      noise"
      "   organised by\n";
  for (const JointGap& joint : diagnosis.joints) {
    text +=
        Format("  %-16s %4s %10s %10s %10s %10s   %s\n", joint.name.c_str(),
               joint.unit.c_str(), FigureText(joint.nominal_rms).c_str(),
               FigureText(joint.refit_rms).c_str(),
               FigureText(joint.after_rms).c_str(),
               FigureText(joint.floor_rms).c_str(), joint.organised.by.c_str());
  }
  return text;
}

std::string Ladder(const GapDiagnosis& diagnosis) {
  const MissingTerms& ladder = diagnosis.ladder;
  if (ladder.terms.empty()) return "";
  std::string text = "\nwhat the robot file gives no joint, fitted; rms left\n";
  const auto row = [&](const std::string& name, const Eigen::VectorXd& left) {
    text += Format("  %-20s", name.c_str());
    for (const double x : left) text += Format(" %8.3g", x);
    text += "\n";
  };
  row("none of it", ladder.without);
  for (const MissingTerm& term : ladder.terms) {
    row("+ " + term.effect->name, term.left);
  }
  return text;
}

std::string Interval(const double* ci95) {
  return std::isfinite(ci95[0]) && std::isfinite(ci95[1])
             ? Format("95 %%: %.0f to %.0f", ci95[0], ci95[1])
             : "the noise is not known well enough for an interval";
}

// "nominal 10.3, refitted diverges, with the effects 1.02".
std::string ThreeGaps(const GapFigures& gap) {
  return "nominal " + FigureText(gap.nominal) + ", refitted " +
         FigureText(gap.refit) + ", with the effects " + FigureText(gap.after);
}

std::string HowFar(const GapFigures& gap) {
  if (!gap.known()) {
    return "\nnothing was held out: how far the gap shrinks is not known\n";
  }
  std::string text =
      "\nheld-out gap, mean square over the noise's: " + ThreeGaps(gap) +
      ", noise 1\n";
  if (gap.refit > gap.nominal) {
    text +=
        "  refitting the file's parameters does worse here than the file: "
        "they took up what is not theirs, or something changed between what "
        "was fitted and what was held out\n";
  }
  if (!std::isfinite(gap.removed_percent)) return text;
  text += Format("  removed %.0f %% of what refitting leaves (%s)",
                 gap.removed_percent, Interval(gap.ci95).c_str());
  // The file alone may leave no more than noise.
  if (std::isfinite(gap.removed_from_nominal_percent)) {
    text +=
        Format(", %.0f %% of the file's gap", gap.removed_from_nominal_percent);
  }
  return text + "\n";
}

// Joints of one effect with one reason in one line; how many there are, where
// the lines are not wanted and would push the answer off the screen.
std::string Untestable(const std::vector<UntestableEffect>& effects,
                       bool verbose) {
  constexpr size_t kFewLines = 5;
  std::vector<std::pair<std::string, std::string>> lines;  // key, joints
  for (const UntestableEffect& effect : effects) {
    const std::string key = effect.effect + ": " + effect.why;
    if (lines.empty() || lines.back().first != key) lines.push_back({key, ""});
    std::string& joints = lines.back().second;
    if (!effect.joint.empty()) {
      joints += (joints.empty() ? "" : ", ") + effect.joint;
    }
  }
  if (!verbose && lines.size() > kFewLines) {
    std::set<std::string> names;
    for (const UntestableEffect& effect : effects) names.insert(effect.effect);
    return Format(
               "\nnot testable on these data, on some joints or all: %zu "
               "effects (",
               names.size()) +
           OptionName("verbose") + ": which, and why)\n";
  }
  std::string text;
  for (const auto& [key, joints] : lines) {
    text += "  " + key + (joints.empty() ? "" : " (" + joints + ")") + "\n";
  }
  return text.empty() ? "" : "\nnot testable on these data\n" + text;
}

std::string Simulated(const ForwardGap& forward) {
  return Format("\nsimulated %s, mean square of positions over the noise's: ",
                forward.closed_loop ? "along the command"
                                    : "over windows of 0.5 s") +
         ThreeGaps(forward.figures) + "\n";
}

// What probabilities of effects are worth in words; "confident" is .8.
const char* Lacks(double least_probability) {
  if (least_probability >= .8) return "lacks";
  return least_probability >= .5 ? "probably lacks" : "may lack";
}

// What happened, and what the model lacks.
std::string Findings(const GapDiagnosis& diagnosis) {
  std::string touched;
  std::vector<std::string> names;
  double least = 1;
  bool terms_alone = true;  // which the refit has as well
  for (const FoundEffect& found : diagnosis.effects) {
    // FrictionChanged() and the data's findings say so.
    if (found.of_another_day || found.of_the_stamps) continue;
    const size_t times = found.contacts.size();
    if (times > 0) {
      touched = "Something touched the arm " +
                (times == 1 ? "once" : std::to_string(times) + " times");
    } else {
      names.push_back(Named(*found.effect, found.joint, diagnosis));
      least = std::min(least, found.probability);
      terms_alone &= found.fitted.empty();
    }
  }
  if (names.empty()) return touched;
  std::string text = (touched.empty() ? "The" : touched + "; the") +
                     std::string(" model ") + Lacks(least) + " " + names[0];
  for (size_t k = 1; k < names.size(); ++k) {
    text += (k + 1 < names.size() ? ", " : " and ") + names[k];
  }
  if (terms_alone) {
    const double less = diagnosis.torque.removed_from_nominal_percent;
    if (!(less >= .5)) return text;
    return text + Format(
                      "; refitted with it, %.0f %% of the file's gap is gone "
                      "on data not used for choosing",
                      less);
  }
  const double removed = diagnosis.torque.removed_percent;
  if (!std::isfinite(removed)) return text;
  if (removed < .5) {
    return text +
           ", which does not shrink the gap on data not used for "
           "choosing";
  }
  return text + Format(
                    ", which removes %.0f %% of the gap that refitting "
                    "leaves on data not used for choosing",
                    removed);
}

std::string Drifts(const std::vector<RunDrift>& drifts) {
  std::string text = drifts.empty() ? "" : "\nfrom log to log\n";
  for (const RunDrift& drift : drifts) {
    text += Format("  %-28s", drift.name.c_str());
    for (const double value : drift.value) text += Format(" %8.4g", value);
    text += Format(" %s, %+.2g +- %.1g per log\n", drift.unit.c_str(),
                   drift.per_log, drift.per_log_stddev);
  }
  return text;
}

// What changes are told since; empty: the robot file, since which nothing is.
std::string Before(const GapDiagnosis& diagnosis) {
  if (diagnosis.has_reference) return "the reference";
  return diagnosis.has_calibration ? "the calibration" : "";
}

std::string MovedTitle(const GapDiagnosis& diagnosis) {
  const std::string before = Before(diagnosis);
  return before.empty() ? "\nparameters far from the file's\n"
                        : "\nfriction that has changed since " + before + "\n";
}

// Friction that differs on several joints is one change, as temperature makes
// it: "Friction has changed since the reference: elbow.viscous -20 %." Empty
// where none has.
std::string FrictionChanged(const GapDiagnosis& diagnosis) {
  const std::string before = Before(diagnosis);
  if (before.empty() || diagnosis.moved.empty()) return "";
  std::string text = "Friction has changed since " + before + ": ";
  for (size_t k = 0; k < diagnosis.moved.size(); ++k) {
    const MovedParameter& moved = diagnosis.moved[k];
    text += (k > 0 ? ", " : "") + moved.name;
    text += moved.nominal != 0
                ? Format(" %+.0f %%", 100 * (moved.value / moved.nominal - 1))
                : Format(" %+.3g %s", moved.value, moved.unit.c_str());
  }
  return text + ".";
}

// What is left given friction that has changed.
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
  switch (diagnosis.verdict) {
    case GapVerdict::kNoiseFloor:
      return "The model agrees with the log to within the noise.";
    case GapVerdict::kAbsorbed:
      return diagnosis.has_reference
                 ? "Nothing but friction and timing has changed since the "
                   "reference."
                 : "Nothing is missing in the model but better values: "
                   "refitting its parameters brings it down to the noise.";
    case GapVerdict::kExplained:
      return Findings(diagnosis) + ".";
    case GapVerdict::kPartlyExplained:
      return Findings(diagnosis) + "; something else is left.";
    case GapVerdict::kUnknown:
      return "Something real is missing that no known effect explains" +
             (diagnosis.unexplained.joint.empty()
                  ? std::string(".")
                  : ": most of it on " + diagnosis.unexplained.joint +
                        (diagnosis.unexplained.organised_by.empty()
                             ? "."
                             : ", ordered by its " +
                                   diagnosis.unexplained.organised_by + "."));
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
  const std::string changed = FrictionChanged(diagnosis);
  if (!changed.empty()) text += changed + " ";
  return text + BriefVerdict(diagnosis);
}

std::string FullReport(const GapDiagnosis& diagnosis, bool verbose) {
  std::string text = BriefReport(diagnosis) + "\n";
  for (const DataFinding& finding : diagnosis.data) {
    text += "note       " + finding.finding + ": " + finding.evidence +
            (finding.flag.empty() ? "" : " (" + finding.flag + ")") + "\n";
  }
  if (!diagnosis.effects.empty()) text += "\nwhich effect\n";
  for (const FoundEffect& found : diagnosis.effects) {
    text += EffectLines(found, diagnosis);
  }
  text += Unnamed(diagnosis);
  text += Ladder(diagnosis) + WhereTable(diagnosis) + HowFar(diagnosis.torque);
  if (diagnosis.forward && diagnosis.forward->has_figures) {
    text += Simulated(*diagnosis.forward);
  }
  text += Format("  noise told from: %s\n", NoiseFloorName(diagnosis.floor));
  text += "  torque: " + ScaleText(diagnosis.torque_constants_stddev) + "\n";
  if (!diagnosis.shown.empty()) text += "\nthe reference itself shows\n";
  for (const ShownEffect& shown : diagnosis.shown) {
    text += "  " + Named(*shown.effect, shown.joint, diagnosis) + ": " +
            Estimates(shown) + "\n";
  }
  if (!diagnosis.moved.empty()) text += MovedTitle(diagnosis);
  for (const MovedParameter& moved : diagnosis.moved) {
    text +=
        Format("  %-28s %10.4g -> %10.4g +- %.2g %s\n", moved.name.c_str(),
               moved.nominal, moved.value, moved.stddev, moved.unit.c_str());
  }
  return text + Drifts(diagnosis.drifts) +
         Untestable(diagnosis.untestable, verbose);
}

}  // namespace armcal
