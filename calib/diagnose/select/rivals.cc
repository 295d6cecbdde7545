#include "calib/diagnose/select/rivals.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/diagnose/candidates/coordinates.h"
#include "calib/diagnose/candidates/refinement.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/form_error.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kOut = -std::numeric_limits<double>::infinity();

// Adds a torque, which may be empty on joints that have none.
void Add(const JointRows& torque, double factor, JointRows* sum) {
  for (size_t j = 0; j < torque.size(); ++j) {
    if (torque[j].size() == 0) continue;
    if ((*sum)[j].size() == 0) {
      (*sum)[j] = factor * torque[j];
    } else {
      (*sum)[j] += factor * torque[j];
    }
  }
}

// The torque that a fitted effect's columns say it has.
JointRows TorqueOfColumns(const GapCandidate& fitted) {
  JointRows sum(fitted.torque[0].size());
  for (size_t i = 0; i < fitted.linear.size(); ++i) {
    Add(fitted.torque[i], fitted.p[fitted.linear[i]] / fitted.size[i], &sum);
  }
  return sum;
}

// By how much less the laws of all effects but the k-th explain than their
// columns, all at these fitted sizes and beside the k-th one's columns: a law
// that bends is not in proportion to a column that was taken at another size.
double LostByLaws(const GapRegression& regression,
                  const std::vector<GapCandidate>& fitted, int k) {
  const std::vector<GapCandidate> others =
      AllBut(fitted, static_cast<size_t>(k));
  if (std::all_of(others.begin(), others.end(), [](const GapCandidate& other) {
        return other.effect->proportional;
      })) {
    return 0;
  }
  JointRows by_laws = TorqueOfColumns(fitted[k]), by_columns = by_laws;
  Add(regression.TorqueOf(others), 1, &by_laws);
  for (const GapCandidate& other : others) {
    Add(TorqueOfColumns(other), 1, &by_columns);
  }
  const VectorXd chi2 = regression.screen().Chi2Given(
      {WhitenEach(regression.rows(), by_laws),
       WhitenEach(regression.rows(), by_columns)});
  return chi2[0] - chi2[1];
}

}  // namespace

// The law of an effect is never quite the robot's, and what a richer one of the
// same joint explains beyond a simpler one may be that error of form: as much
// as one more effect on that joint has to exceed (`share` of delta_chi2,
// form_error.h) is no evidence for it.
void LeaveOutErrorsOfForm(double share, std::vector<FittedRival>* rivals) {
  const std::vector<FittedRival> as_fitted = *rivals;
  for (FittedRival& richer : *rivals) {
    const double explained = richer.delta_chi2;
    for (const FittedRival& simpler : as_fitted) {
      if (simpler.joint != richer.joint || simpler.joint < 0) continue;
      if (!(simpler.penalty < richer.penalty)) continue;
      if (simpler.delta_chi2 < (1 - share) * explained) continue;
      richer.delta_chi2 = std::min(richer.delta_chi2, simpler.delta_chi2);
    }
  }
}

// A grid of shapes samples some effects densely and others hardly, and so
// favours the former. The candidates whose scores in the k-th place are within
// max(20, half of its delta_chi2) of the chosen one's, kMostRivals of them at
// most, therefore have their shapes fitted as the chosen one has, while all
// other effects stay as they are. The score is then
//   delta_chi2 of all - delta_chi2 of the others - RefinedPenalty,
// where a fitted shape counts as parameters. The others are laws beside a
// rival and columns by themselves; what they lose by that is no rival's
// (LostByLaws), whose scores stand beside those of candidates that were not
// fitted. A rival whose estimates no real arm can have (Effect::plausible)
// stands behind every one that is possible, whatever its score; one whose score
// is not finite, since its torque is not at where its fit starts or ends, is no
// rival.
Rivals CompareRivals(const GapRegression& regression, const CandidatePool& pool,
                     const SelectionOptions& options,
                     const Selection& selection, int k) {
  constexpr int kMostRivals = 3;
  constexpr double kNear = .5;  // of delta chi^2
  const GapScreen& screen = regression.screen();
  const std::vector<GapCandidate>& candidates = pool.candidates();
  VectorXd scores =
      ScoresGiven(screen, candidates, options, selection.chosen, k);
  const double least =
      selection.scores[k] - std::max(20., kNear * selection.delta_chi2[k]);
  const double by_others =
      TotalDeltaChi2(screen, candidates, Without(selection.chosen, k));
  // What happened once is no rival of what lasts: it was taken out.
  for (int i = 0; i < scores.size(); ++i) {
    if (candidates[i].log >= 0) scores[i] = kOut;
  }
  std::vector<int> near;
  while (static_cast<int>(near.size()) < 1 + kMostRivals) {
    int c;
    if (!(scores.maxCoeff(&c) >= least)) break;
    near.push_back(c);
    for (int i = 0; i < scores.size(); ++i) {
      if (SamePlace(candidates[i], candidates[c])) scores[i] = kOut;
    }
  }
  const GapBaseline& baseline = regression.baseline();
  const MotionScale& scale = regression.scale();
  std::vector<RefinedEffects> refined(near.size());
  VectorXd lost(near.size());
  tbb::parallel_for(size_t{0}, near.size(), [&](size_t r) {
    std::vector<int> chosen = selection.chosen;
    chosen[k] = near[r];
    const std::vector<GapCandidate> fitted = pool.Fitted(chosen);
    refined[r] =
        RefineEffects(screen, baseline, scale, fitted, k, regression.data());
    lost[static_cast<Eigen::Index>(r)] = LostByLaws(regression, fitted, k);
  });
  std::vector<FittedRival> fitted;
  for (size_t r = 0; r < near.size(); ++r) {
    const GapCandidate& rival = candidates[near[r]];
    const size_t varied = ListCoordinates(baseline, scale, {rival}, 0).size();
    fitted.push_back({rival.joint, refined[r].delta_chi2 + lost[r] - by_others,
                      RefinedPenalty(screen, rival, static_cast<int>(varied))});
  }
  LeaveOutErrorsOfForm(options.same_joint_share, &fitted);
  Rivals rivals{{}, selection.chosen[k], {}};
  double best_score = kOut;
  bool best_is_possible = false;
  for (size_t r = 0; r < near.size(); ++r) {
    const GapCandidate& rival = candidates[near[r]];
    const double score = fitted[r].delta_chi2 - fitted[r].penalty;
    const bool is_possible =
        IsPossible(refined[r].effects[k], baseline.robot(), scale) &&
        regression.CouldHaveLost(refined[r].effects[k], refined[r].effects);
    rivals.scores.push_back({rival.effect, rival.joint, score, is_possible});
    if (!std::isfinite(score)) continue;
    if (is_possible < best_is_possible) continue;
    if (is_possible == best_is_possible && !(score > best_score)) continue;
    best_score = score;
    best_is_possible = is_possible;
    rivals.best = near[r];
    rivals.refined = refined[r];
  }
  return rivals;
}

}  // namespace armcal
