#include "calib/diagnose/report.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "calib/diagnose/names.h"
#include "calib/diagnose/next_steps.h"
#include "calib/diagnose/sentence.h"
#include "model/log_files/torque_columns.h"
#include "model/text/format.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// What nothing tells of is as it was: at 0, without a deviation. Numbers that
// are chosen, not fitted, have none either.
std::string ValueText(double value, double stddev) {
  if (stddev > 0) return Format("%.3g +- %.1g", value, stddev);
  return value == 0 ? "not seen" : Format("%.3g", value);
}

// Of a FoundEffect or a ShownEffect, with the separators that go between them.
template <typename Found>
std::vector<std::string> EstimateTexts(const Found& found) {
  std::vector<std::string> texts;
  for (size_t k = 0; k < found.estimates.size(); ++k) {
    const EffectEstimate& estimate = found.estimates[k];
    const bool unit =
        estimate.unit != "1" && (estimate.value != 0 || found.stddev[k] > 0);
    texts.push_back(estimate.name + " " +
                    ValueText(estimate.value, found.stddev[k]) +
                    (unit ? " " + estimate.unit : "") +
                    (k + 1 < found.estimates.size() ? "," : ""));
  }
  return texts;
}

template <typename Found>
std::string Estimates(const Found& found) {
  std::string text;
  for (const std::string& one : EstimateTexts(found)) {
    text += (text.empty() ? "" : " ") + one;
  }
  return text;
}

// Items one after the other behind `line`, on further lines where a screen
// ends.
std::string Wrapped(std::string line, const std::vector<std::string>& items) {
  constexpr size_t kScreen = 100;
  const std::string indent(9, ' ');
  std::string text;
  for (const std::string& item : items) {
    if (line.size() + 1 + item.size() > kScreen) {
      text += line + "\n";
      line = indent + item;
    } else {
      line += " " + item;
    }
  }
  return text + line + "\n";
}

// What else it may be, and what would tell.
std::string Others(const FoundEffect& found, const GapDiagnosis& diagnosis) {
  constexpr double kWorthSaying = .02;
  std::string text;
  for (const PlacedEffect& other : found.equivalent) {
    if (other.probability < kWorthSaying) continue;
    const bool is_form_of_it =
        other.joint == found.joint && HasMean(*other.effect, *found.effect);
    // The first words name it as well.
    const bool is_place_of_it = std::any_of(
        found.or_at.begin(), found.or_at.end(), [&](const PlacedEffect& place) {
          return place.effect == other.effect && place.joint == other.joint;
        });
    text +=
        Format(is_form_of_it || is_place_of_it ? "         of these %.0f %% as "
                                               : "         or %.0f %% ",
               100 * other.probability) +
        NameOf(*other.effect, other.joint, diagnosis) + "\n";
  }
  if (!found.separate_by.empty()) {
    text += "         told apart by: " + found.separate_by + "\n";
  }
  return text;
}

// Of numbers that each joint has, those whose 95 % interval holds 0 are left
// out, and only named: this motion does not tell them. All stay where none is
// told.
std::string Numbers(const std::string& title, const FoundEffect& found) {
  constexpr double kInterval = 1.96;
  FoundEffect told = found;
  std::vector<std::string> untold;
  if (found.missing_term || found.of_another_day) {
    told.estimates.clear();
    told.stddev.clear();
    for (size_t k = 0; k < found.estimates.size(); ++k) {
      const EffectEstimate& one = found.estimates[k];
      if (std::abs(one.value) < kInterval * found.stddev[k]) {
        if (!untold.empty()) untold.back() += ",";
        untold.push_back(one.name);
      } else {
        told.estimates.push_back(one);
        told.stddev.push_back(found.stddev[k]);
      }
    }
  }
  if (told.estimates.empty() || untold.empty()) {
    return Wrapped(title, EstimateTexts(found));
  }
  return Wrapped(title, EstimateTexts(told)) +
         Wrapped("         not told by this motion:", untold);
}

std::string EffectLines(const FoundEffect& found,
                        const GapDiagnosis& diagnosis) {
  std::string text = Numbers(Format("  %3.0f %%  ", 100 * found.probability) +
                                 NameOf(found, diagnosis) + ":",
                             found);
  for (const Contact& contact : found.contacts) {
    const JointGap& joint = diagnosis.joints[contact.joint];
    text +=
        Format("         %.1f to %.1f s: %.3g +- %.1g ", contact.window.begin,
               contact.window.end, contact.torque[contact.joint],
               contact.stddev[contact.joint]) +
        joint.unit + " on " + joint.name + "\n";
  }
  return text + Others(found, diagnosis);
}

// What joints of a robot that one effect is to be of have it to be, each by
// itself, and what that may be instead.
std::string Disagreement(const FoundEffect& found,
                         const GapDiagnosis& diagnosis) {
  if (found.joint_sizes.empty()) return "";
  std::vector<std::string> sizes;
  for (const JointAgreement::JointSize& one : found.joint_sizes) {
    sizes.push_back(diagnosis.joints[one.joint].name + " " +
                    ValueText(one.value, one.stddev) + " " +
                    found.estimates[0].unit);
    if (&one != &found.joint_sizes.back()) sizes.back() += ",";
  }
  std::string text =
      Wrapped(sizes.size() > 1 ? "         its joints disagree:"
                               : "         one joint alone tells it:",
              sizes);
  if (!found.effect->if_joints_disagree.empty()) {
    text += "         which may be " + found.effect->if_joints_disagree + "\n";
  }
  return text;
}

// What the data ask for as well, but no name is probable enough for: no part of
// any figure here.
std::string Unnamed(const GapDiagnosis& diagnosis) {
  std::string text = diagnosis.unnamed.empty() ? "" : "\nfitted, not named\n";
  for (const FoundEffect& found : diagnosis.unnamed) {
    text += Format("  %3.0f %%  ", 100 * found.probability) +
            NameOf(*found.effect, found.joint, diagnosis);
    if (found.removed_percent > 0) {
      text += Format(": would remove %.0f %% of what refitting leaves",
                     found.removed_percent);
    } else if (std::isfinite(found.removed_percent)) {
      text += found.gain.IsNone() ? ": held out, it removes nothing"
                                  : ": held out, too small to show";
    }
    text += "\n" + Disagreement(found, diagnosis);
    if (found.one_of_few) text += Others(found, diagnosis);
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

std::string Next(const GapDiagnosis& diagnosis) {
  std::string text;
  for (const std::string& step : NextSteps(diagnosis)) {
    text += (text.empty() ? "\nnext\n" : "") + ("  " + step) + "\n";
  }
  return text;
}

// Laws of the reference with their values, and by name those that help to
// predict it but share their torque with others.
std::string ReferenceShows(const GapDiagnosis& diagnosis) {
  const bool of_calibration = diagnosis.calibrations_logs ==
                              GapDiagnosis::CalibrationsLogs::kAreTheReference;
  std::string text =
      diagnosis.shown.empty() ? ""
      : of_calibration
          ? "\nwhat the calibrated robot lacks, as its own logs show\n"
          : "\nthe reference itself shows\n";
  std::vector<std::string> others;
  for (const ShownEffect& shown : diagnosis.shown) {
    const std::string name = NameOf(*shown.effect, shown.joint, diagnosis);
    if (!shown.is_significant) {
      others.push_back(name);
      continue;
    }
    text += "  " + name + ": " + Estimates(shown) + "\n";
  }
  return text + (others.empty() ? ""
                                : "  laws whose sizes it does not tell: " +
                                      JoinNames(others) + "\n");
}

std::string MovedTitle(const GapDiagnosis& diagnosis) {
  const std::string before = SinceWhat(diagnosis);
  return before.empty() ? "\nparameters far from the file's\n"
                        : "\nwhat has changed since " + before + "\n";
}

}  // namespace

std::string FullReport(const GapDiagnosis& diagnosis, bool verbose) {
  std::string text = BriefReport(diagnosis) + "\n";
  for (const DataFinding& finding : diagnosis.data) {
    text += "note       " + finding.finding + ": " + finding.evidence +
            (finding.flag.empty() ? "" : " (" + finding.flag + ")") + "\n";
  }
  if (!diagnosis.effects.empty())
    text += "\nwhich effect (how probable; values +- one standard deviation)\n";
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
  text += ReferenceShows(diagnosis);
  if (!diagnosis.moved.empty()) text += MovedTitle(diagnosis);
  for (const MovedParameter& moved : diagnosis.moved) {
    text +=
        Format("  %-28s %10.4g -> %10.4g +- %.2g %s\n", moved.name.c_str(),
               moved.nominal, moved.value, moved.stddev, moved.unit.c_str());
  }
  return text + Drifts(diagnosis.drifts) +
         Untestable(diagnosis.untestable, verbose) + Next(diagnosis);
}

}  // namespace armcal
