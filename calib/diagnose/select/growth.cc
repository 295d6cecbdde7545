#include "calib/diagnose/select/growth.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/candidates/effect_odds.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/moved_zeros.h"
#include "calib/diagnose/select/next_effect.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Of each joint the candidate of this effect that scores best by itself; none
// where no effect has that name.
std::vector<int> BestOfEachJoint(const GapRegression& regression,
                                 const std::vector<GapCandidate>& candidates,
                                 const SelectionOptions& options,
                                 const std::vector<int>& set,
                                 const std::string& name) {
  const GapScreen& screen = regression.screen();
  const VectorXd scores = ScoresGiven(screen, candidates, options, set, -1);
  std::vector<int> best(screen.num_joints(), -1);
  for (int k = 0; k < static_cast<int>(candidates.size()); ++k) {
    if (candidates[k].effect->name != name || std::isinf(scores[k])) continue;
    int& of_joint = best[candidates[k].joint];
    if (of_joint < 0 || scores[k] > scores[of_joint]) of_joint = k;
  }
  best.erase(std::remove(best.begin(), best.end(), -1), best.end());
  return best;
}

// Whether candidate c, of all joints and with these odds less its penalty, is
// less likely than what looks so where each joint has it by itself:
//   - another effect (Effect::if_of_each_joint), of each joint the shape that
//     scores best;
//   - friction that changes sign earlier or later than the recorded velocity,
//     by a time of each joint's own, where inertia and gravity are in time
//     (Effect::moves_reversals): friction that yields before it breaks away,
//     that creeps, or that a simulator keeps smooth;
//   - both.
// It is as if it were that, too, where torque is late and joints have friction
// of their own besides: then it is still asked for beside them, by inertia and
// gravity that are late as well.
// One number for all joints costs less than one for each, and of few effects
// that a selection may have it explains the most; so that it would stand for
// all of them.
bool IsOfEachJoint(const GapRegression& regression,
                   const std::vector<GapCandidate>& candidates,
                   const SelectionOptions& options, const std::vector<int>& set,
                   const GapScreen& smaller, int c, double odds) {
  const Effect& effect = *candidates[c].effect;
  // Likelier than the candidate, and no likelier with it.
  const auto is_it = [&](std::vector<int> others,
                         const std::vector<JointRows>& columns) {
    const auto score = [&] {
      return ScoreTogether(regression, candidates, set, smaller, others,
                           columns);
    };
    const double without = score();
    if (!(without > odds)) return false;
    others.push_back(c);
    return without >= score();
  };
  const std::vector<int> others = BestOfEachJoint(
      regression, candidates, options, set, effect.if_of_each_joint);
  if (!others.empty() && is_it(others, {})) return true;
  if (!effect.moves_reversals) return false;
  const std::vector<JointRows> late =
      LateFriction(regression.baseline(), *regression.data());
  return is_it({}, late) || is_it(others, late);
}

}  // namespace

// Forward selection by the odds of the larger model against the smaller one,
//   CompareLarger(set, set + candidate).odds - Penalty(candidate),
// both under the correlation that the larger one leaves. This differs from the
// scores of SelectEffects in that variance and correlation time are functions
// of the model and not of the data: N / time log(v0 / v1) grows without bound
// as an effect explains the whole residual, whereas delta_chi2 under the
// smaller model's variance is N / time at most. After each step the regression
// is weighed by what the set leaves (SettleEvidence), for which the next
// candidate has to be seen.
Growth GrowEffects(const std::vector<GapCandidate>& candidates,
                   const SelectionOptions& options, GapRegression* regression) {
  std::vector<int> set;
  regression->SettleEvidence({});
  while (static_cast<int>(set.size()) < options.most_effects) {
    const GapScreen smaller =
        regression->screen().Only(ColumnsOf(candidates, set));
    const NextEffect next =
        NextOf(*regression, candidates, options, set, smaller);
    if (regression->HoldsZeros() &&
        HaveZerosMoved(candidates, options, set, smaller, next, regression)) {
      return {set, true, -1};
    }
    if (next.candidate < 0) break;
    if (IsOfEachJoint(*regression, candidates, options, set, smaller,
                      next.candidate, next.odds)) {
      return {set, false, next.candidate};
    }
    set.push_back(next.candidate);
    regression->SettleEvidence(ColumnsOf(candidates, set));
  }
  return {set, false, -1};
}

}  // namespace armcal
