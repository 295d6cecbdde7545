#include "tools/commands/calibrate_flags.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>

#include "calib/linear/transition_choice.h"
#include "model/text/input_text.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"

DEFINE_string(
    geometry, "known",
    "known; lengths (between the joint axes: those the robot file declares "
    "unknown, or all that are not zero, are estimated), all_lengths; offsets "
    "(joint zeros are refined), refine (all of the file's geometry is)");
DEFINE_string(identification, "weak",
              "weak (test functions, no acceleration), differential (2.19), "
              "integral (2.27)");
DEFINE_string(solver, "weighted",
              "weighted (noise of every joint re-estimated), batch (2.25), "
              "recursive (2.28)");
DEFINE_string(joint_terms, "viscous,coulomb,offset,armature",
              "what joints add to the rigid arm, or none");
DEFINE_string(coulomb_width, "auto",
              "how Coulomb friction changes sign: auto (fitted per joint), a "
              "speed such as 0.02rad/s, or a displacement such as 0.001rad, "
              "for all joints");
DEFINE_string(window, "",
              "`S` length of the weak form's test functions, s; default: .87 "
              "periods of the bandwidth, to 0.3 for noise");
DEFINE_string(
    intervals, "",
    "`T1:T2[,..]` integral model: from T1 to T2, s; default: side by side");
DEFINE_double(interval, 0.5, "`S` integral model: length of intervals");
DEFINE_string(quadrature, "trapezoid", "integral model: trapezoid, simpson");

namespace armcal {
namespace {

const FlagChoices<GeometryKnowledge> kGeometries(
    "geometry", {{"known", GeometryKnowledge::kKnown},
                 {"lengths", GeometryKnowledge::kNonzeroLengths},
                 {"all_lengths", GeometryKnowledge::kAllLengths},
                 {"offsets", GeometryKnowledge::kKnown},
                 {"refine", GeometryKnowledge::kKnown}});
const FlagChoices<JointTerm> kJointTerms("joint_terms",
                                         {{"viscous", JointTerm::kViscous},
                                          {"coulomb", JointTerm::kCoulomb},
                                          {"offset", JointTerm::kOffset},
                                          {"armature", JointTerm::kArmature}},
                                         true);
const FlagChoices<Identification> kIdentifications(
    "identification", {{"weak", Identification::kWeak},
                       {"differential", Identification::kDifferential},
                       {"integral", Identification::kIntegral}});
const FlagChoices<LinearSolver> kSolvers("solver",
                                         {{"weighted", LinearSolver::kWeighted},
                                          {"batch", LinearSolver::kBatch},
                                          {"recursive",
                                           LinearSolver::kRecursive}});
const FlagChoices<Quadrature> kQuadratures(
    "quadrature",
    {{"trapezoid", Quadrature::kTrapezoid}, {"simpson", Quadrature::kSimpson}});

GeometryKnowledge GeometryFromFlags(const FlagValues& flags,
                                    const Robot& robot) {
  const GeometryKnowledge knowledge = kGeometries.Parse(flags.Text("geometry"));
  if (knowledge != GeometryKnowledge::kNonzeroLengths) return knowledge;
  for (const Link& link : robot.links) {
    if (!link.unknown_lengths.empty()) {
      return GeometryKnowledge::kDeclaredLengths;
    }
  }
  return GeometryKnowledge::kNonzeroLengths;
}

std::vector<JointTerm> JointTermsFromFlags(const FlagValues& flags) {
  std::vector<JointTerm> terms;
  if (flags.Text("joint_terms") == "none") return terms;
  for (const std::string& name : SplitAtCommas(flags.Text("joint_terms"))) {
    const JointTerm term = kJointTerms.Parse(name);
    if (std::count(terms.begin(), terms.end(), term) > 0) {
      throw UsageError("--joint_terms: found '" + flags.Text("joint_terms") +
                       "', expected " + name + " only once");
    }
    terms.push_back(term);
  }
  return terms;
}

std::optional<CoulombTransition> TransitionFromFlags(const FlagValues& flags) {
  using Law = CoulombTransition::Law;
  const std::string text = flags.Text("coulomb_width");
  if (text == "auto") return std::nullopt;
  for (const auto& [unit, law] :
       std::vector<std::pair<std::string, Law>>{{"rad/s", Law::kVelocity},
                                                {"m/s", Law::kVelocity},
                                                {"rad", Law::kDisplacement},
                                                {"m", Law::kDisplacement}}) {
    const size_t at = text.rfind(unit);
    if (at == std::string::npos || at + unit.size() != text.size()) continue;
    const double width = PositiveNumber("coulomb_width", text.substr(0, at));
    if (width < kLeastTransition) {
      throw UsageError("--coulomb_width: found '" + text +
                       "', expected a width of at least " +
                       NumberText(kLeastTransition));
    }
    return CoulombTransition{law, width};
  }
  throw UsageError("--coulomb_width: found '" + text +
                   "', expected auto, a speed (0.02rad/s) or a displacement "
                   "(0.001rad)");
}

}  // namespace

LinearCalibrationOptions LinearOptionsFromFlags(const FlagValues& flags,
                                                const Robot& robot) {
  LinearCalibrationOptions options;
  options.geometry = GeometryFromFlags(flags, robot);
  options.joint_terms = JointTermsFromFlags(flags);
  options.transition = TransitionFromFlags(flags);
  options.identification = kIdentifications.Parse(flags.Text("identification"));
  options.solver = kSolvers.Parse(flags.Text("solver"));
  options.loss = LossFromFlags(flags);
  options.quadrature = kQuadratures.Parse(flags.Text("quadrature"));
  if (!flags.Text("window").empty()) {
    options.window_s = PositiveNumber("window", flags.Text("window"));
  }
  options.intervals = ParseRanges("intervals", flags.Text("intervals"));
  for (const TimeRange& range : options.intervals) {
    if (!std::isfinite(range.begin) || !std::isfinite(range.end)) {
      throw UsageError("--intervals: found '" + flags.Text("intervals") +
                       "', expected t1:t2 with both ends");
    }
  }
  options.interval_s = flags.Number("interval");
  if (!(options.interval_s > 0) || !std::isfinite(options.interval_s)) {
    throw UsageError("--interval: found '" + NumberText(options.interval_s) +
                     "', expected a length in s above 0");
  }
  options.bandwidth_hz = BandwidthFromFlags(flags);
  return options;
}

}  // namespace armcal
