#include "calib/diagnose/select/moved_zeros.h"

#include <algorithm>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/evidence_noise.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

std::vector<int> Offsets(const std::vector<GapCandidate>& candidates) {
  std::vector<int> offsets;
  for (int c = 0; c < static_cast<int>(candidates.size()); ++c) {
    if (candidates[c].effect->joint_term == JointTerm::kOffset) {
      offsets.push_back(c);
    }
  }
  return offsets;
}

// The offsets of all joints and the rest of a set.
std::vector<int> WithOffsets(const std::vector<GapCandidate>& candidates,
                             const std::vector<int>& set) {
  std::vector<int> more = Offsets(candidates);
  for (const int c : set) {
    if (candidates[c].effect->joint_term != JointTerm::kOffset) {
      more.push_back(c);
    }
  }
  return more;
}

// Whether offsets on several joints, none of which could be spared, are
// together likelier than what is likeliest by itself (`best`, above the
// threshold). Zeros of torque sensors and drives wander from day to day on all
// joints, each by so little that another effect on many joints (an added mass)
// is likelier than any of these offsets, and stands for them.
bool MayZerosHaveMoved(const GapRegression& regression,
                       const std::vector<GapCandidate>& candidates,
                       const SelectionOptions& options,
                       const std::vector<int>& set, const GapScreen& smaller,
                       double best) {
  const GapScreen& screen = regression.screen();
  const std::vector<int> offsets = Offsets(candidates);
  if (static_cast<double>(offsets.size()) < Limits().several_joints) {
    return false;
  }
  if (ScoreTogether(regression, candidates, set, smaller, offsets) <
      std::max(best, options.threshold)) {
    return false;
  }
  const std::vector<int> more = WithOffsets(candidates, set);
  const GapScreen larger = screen.Only(ColumnsOf(candidates, more));
  const VectorXd stddev = regression.evidence().stddev();
  int needed = 0;
  for (size_t k = 0; k < offsets.size(); ++k) {
    const GapScreen without =
        screen.Only(ColumnsOf(candidates, Without(more, static_cast<int>(k))));
    const LargerModel with =
        CompareLarger(without, larger, SettleNoise(without, stddev));
    needed +=
        with.odds - Penalty(screen, candidates[offsets[k]]) > options.threshold;
  }
  return needed >= Limits().several_joints;
}

// What is added to a set effect by effect, each the likeliest, with 2 log of
// the odds of all of them.
struct LongerSet {
  std::vector<int> set;
  double odds = 0;
};
LongerSet Continued(const std::vector<GapCandidate>& candidates,
                    const SelectionOptions& options,
                    const std::vector<int>& set, size_t most,
                    GapRegression* regression) {
  LongerSet longer{set, 0};
  while (longer.set.size() < most) {
    const std::vector<int> columns = ColumnsOf(candidates, longer.set);
    regression->SettleEvidence(columns);
    const NextEffect step = NextOf(*regression, candidates, options, longer.set,
                                   regression->screen().Only(columns));
    if (!(step.best_odds > options.threshold)) break;
    longer.odds += step.best_odds;
    longer.set.push_back(step.best);
  }
  return longer;
}

}  // namespace

bool HaveZerosMoved(const std::vector<GapCandidate>& candidates,
                    const SelectionOptions& options,
                    const std::vector<int>& set, const GapScreen& smaller,
                    const NextEffect& next, GapRegression* regression) {
  if (!MayZerosHaveMoved(*regression, candidates, options, set, smaller,
                         next.best_odds)) {
    return false;
  }
  const std::vector<int> offsets = Offsets(candidates),
                         with = WithOffsets(candidates, set);
  const size_t most = options.most_effects + with.size() - set.size();
  const double together =
      ScoreTogether(*regression, candidates, set, smaller, offsets);
  const double zeros =
      together + Continued(candidates, options, with, most, regression).odds;
  const LongerSet effects =
      Continued(candidates, options, set, most, regression);
  regression->SettleEvidence(ColumnsOf(candidates, set));
  const auto single =
      std::count_if(effects.set.begin(), effects.set.end(), [&](int c) {
        return candidates[c].effect->joint_term == JointTerm::kOffset;
      });
  return single >= Limits().several_joints ||
         zeros > effects.odds + options.threshold;
}

}  // namespace armcal
