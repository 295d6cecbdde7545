#include "calib/diagnose/freedom.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/evidence_noise.h"
#include "calib/diagnose/select/form_error.h"
#include "model/effects/effects.h"

namespace armcal {
namespace {

MissingTerm* Find(JointTerm term, MissingTerms* missing) {
  for (MissingTerm& one : missing->terms) {
    if (one.joint_term == term) return &one;
  }
  return nullptr;
}

// The catalogue's changes of one joint term, a candidate per joint.
struct TermChange {
  const Effect* effect;
  std::vector<int> candidates;
};

// Those of friction and armature that were not chosen themselves.
std::vector<TermChange> TermChanges(const GapFit& fit) {
  std::vector<TermChange> changes;
  for (const Effect& effect : Effects()) {
    const bool is_of_robot = effect.nature != Effect::Nature::kRecording;
    if (!effect.joint_term || !is_of_robot) continue;
    TermChange change = {&effect, {}};
    for (size_t i = 0; i < fit.candidates().size(); ++i) {
      const GapCandidate& candidate = fit.candidates()[i];
      if (candidate.effect != &effect) continue;
      const auto& chosen = fit.selection().chosen;
      if (std::none_of(chosen.begin(), chosen.end(), [&](int c) {
            return SamePlace(fit.candidates()[c], candidate);
          })) {
        change.candidates.push_back(static_cast<int>(i));
      }
    }
    if (!change.candidates.empty()) changes.push_back(std::move(change));
  }
  return changes;
}

GapScreen::Fit SolveWith(const GapFit& fit,
                         const std::vector<TermChange>& changes) {
  std::vector<int> all = fit.selection().chosen;
  for (const TermChange& change : changes) {
    all.insert(all.end(), change.candidates.begin(), change.candidates.end());
  }
  return fit.screen().Solve(ColumnsOf(fit.candidates(), all));
}

// Joints of which more is explained by `more` beyond `fewer` than is left.
int JointsExplained(const GapScreen& screen, const GapScreen::Fit& fewer,
                    const GapScreen::Fit& more) {
  const JointRows before = screen.Residuals(fewer);
  const JointRows after = screen.Residuals(more);
  int joints = 0;
  for (size_t j = 0; j < before.size(); ++j) {
    joints += after[j].squaredNorm() <
              (1 - Limits().explains) * before[j].squaredNorm();
  }
  return joints;
}

// The change that is needed least beside the others, by its delta_chi2 less the
// least that is asked of an effect on as many joints: the threshold and ln N
// for each. Nothing where all are needed.
std::optional<size_t> LeastNeeded(const GapFit& fit,
                                  const std::vector<TermChange>& changes) {
  const double log_rows =
      std::log(std::max(1., static_cast<double>(fit.rows().num_rows())));
  const double all = SolveWith(fit, changes).delta_chi2;
  std::optional<size_t> least;
  double margin = 0;
  for (size_t k = 0; k < changes.size(); ++k) {
    std::vector<TermChange> others = changes;
    others.erase(others.begin() + static_cast<long>(k));
    const double own =
        all - SolveWith(fit, others).delta_chi2 -
        fit.selection_options().threshold -
        static_cast<double>(changes[k].candidates.size()) * log_rows;
    if (own >= margin) continue;
    margin = own;
    least = k;
  }
  return least;
}

// Those of all joints that the logs contradict (freedom.h).
std::vector<TermChange> ContradictedChanges(const GapFit& fit) {
  // One joint's friction is one number among others that may have changed.
  if (!fit.rows().has_evidence() || fit.rows().num_joints() < 2) return {};
  std::vector<TermChange> changes = TermChanges(fit);
  while (const auto least = LeastNeeded(fit, changes)) {
    changes.erase(changes.begin() + static_cast<long>(*least));
  }
  if (changes.empty() || JointsExplained(fit.screen(), SolveWith(fit, {}),
                                         SolveWith(fit, changes)) <
                             SeveralOf(fit.rows().num_joints())) {
    return {};
  }
  return changes;
}

std::vector<const Effect*> EffectsOf(const std::vector<TermChange>& changes) {
  std::vector<const Effect*> terms;
  for (const TermChange& change : changes) terms.push_back(change.effect);
  return terms;
}

// Joints of which a term with its change has less than half in common with
// what it was, and the change is more than chance.
std::set<int> JointsOfOtherDrives(const GapFit& fit,
                                  const std::vector<TermChange>& changes) {
  const GapScreen::Fit with = SolveWith(fit, changes);
  Eigen::Index at = static_cast<Eigen::Index>(
      ColumnsOf(fit.candidates(), fit.selection().chosen).size());
  std::set<int> joints;
  for (const TermChange& change : changes) {
    for (const int c : change.candidates) {
      const GapCandidate& candidate = fit.candidates()[c];
      const Joint& joint = fit.baseline().robot().links[candidate.joint].joint;
      const double before = TermOf(*change.effect->joint_term, joint);
      const double changed = with.coefficients[at] * candidate.size[0];
      const double deviation =
          std::sqrt(with.covariance(at, at)) * candidate.size[0];
      ++at;
      const auto [less, more] = std::minmax(before, before + changed);
      if (less < (1 - Limits().explains) * more &&
          std::abs(changed) > Limits().by_chance * deviation) {
        joints.insert(candidate.joint);
      }
    }
  }
  return joints;
}

}  // namespace

std::vector<const Effect*> ContradictedTerms(const GapFit& fit) {
  return EffectsOf(ContradictedChanges(fit));
}

std::vector<const Effect*> TermsOfOtherDrives(const GapFit& fit) {
  const std::vector<TermChange> changes = ContradictedChanges(fit);
  if (changes.empty()) return {};
  const std::set<int> joints = JointsOfOtherDrives(fit, changes);
  if (static_cast<double>(joints.size()) < SeveralOf(fit.rows().num_joints()))
    return {};
  return EffectsOf(changes);
}

MissingTerms FitWithout(const std::vector<JointTerm>& not_believed,
                        const Robot& file, const BaselineOptions& options,
                        double bandwidth_hz,
                        const std::vector<GapSegment>& segments) {
  Robot without = file;
  for (Link& link : without.links) {
    for (const JointTerm term : not_believed) *TermOf(term, &link.joint) = 0;
  }
  return FitMissingTerms(without, options, bandwidth_hz, segments);
}

MissingTerms FitTermsOfReference(const Robot& file,
                                 const BaselineOptions& options,
                                 double bandwidth_hz,
                                 const std::vector<GapSegment>& reference) {
  MissingTerms missing =
      FitMissingTerms(file, options, bandwidth_hz, reference);
  std::vector<JointTerm> not_believed =
      FindPlaceholders(missing.robot, options, bandwidth_hz, reference);
  if (not_believed.empty()) return missing;
  for (const MissingTerm& term : missing.terms) {
    not_believed.push_back(term.joint_term);
  }
  return FitWithout(not_believed, file, options, bandwidth_hz, reference);
}

bool GiveUpContradicted(const GapFit& fit, const Robot& file,
                        const BaselineOptions& options, double bandwidth_hz,
                        const std::vector<GapSegment>& segments,
                        MissingTerms* missing) {
  if (options.posterior != nullptr) return false;
  std::vector<JointTerm> not_believed;
  for (const Effect* effect : ContradictedTerms(fit)) {
    const JointTerm term = *effect->joint_term;
    if (Find(term, missing) == nullptr) not_believed.push_back(term);
  }
  if (not_believed.empty()) return false;
  for (const MissingTerm& term : missing->terms) {
    not_believed.push_back(term.joint_term);
  }
  *missing = FitWithout(not_believed, file, options, bandwidth_hz, segments);
  return true;
}

// A joint's term keeps 1e-6 of its usual size, as where logs ask for none
// (FitMissingTerms), and no column.
bool HoldNegative(const GapFit& fit, MissingTerms* missing) {
  const GapBaseline& baseline = fit.baseline();
  const Robot robot = baseline.With(fit.model_after());
  const Eigen::VectorXd variance = fit.screen().BaselineCovariance().diagonal();
  bool any = false;
  for (int c = 0; c < baseline.size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    if (column.kind != BaselineColumn::Kind::kTerm) continue;
    MissingTerm* term = Find(static_cast<JointTerm>(column.index), missing);
    const int j = column.joint;
    if (term == nullptr || term->joint_term == JointTerm::kOffset) continue;
    const double deviation = column.spread * std::sqrt(variance[c]);
    if (TermOf(term->joint_term, robot.links[j].joint) >= -deviation) continue;
    *TermOf(term->joint_term, &missing->robot.links[j].joint) =
        1e-6 * term->usual[j];
    term->value[j] = term->usual[j] = 0;
    any = true;
  }
  return any;
}

namespace {

// Of these columns of the baseline given what is chosen, by half decades.
double LikeliestScaleOf(const GapFit& fit, const std::vector<int>& columns) {
  // Torques that were reconstructed keep the noise of their positions.
  if (!fit.rows().has_evidence()) return 1;
  const GapScreen chosen =
      fit.screen().Only(ColumnsOf(fit.candidates(), fit.selection().chosen));
  return LikeliestScale(chosen, fit.regression().evidence(), columns,
                        {1, 3, 10});
}

}  // namespace

// By half decades, from the 5 % of a file taken at its word to the 50 % that
// calibrations give one.
double LikeliestTrust(const GapFit& fit) {
  const GapBaseline& baseline = fit.baseline();
  std::vector<int> inertial;
  for (int c = 0; c < baseline.size(); ++c) {
    const bool is_inertial =
        baseline.columns()[c].kind == BaselineColumn::Kind::kInertial;
    if (is_inertial) inertial.push_back(c);
  }
  return LikeliestScaleOf(fit, inertial);
}

double LikeliestPosterior(const GapFit& fit) {
  return LikeliestScaleOf(fit, fit.baseline().prior().which());
}

}  // namespace armcal
