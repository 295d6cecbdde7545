#include "calib/diagnose/select/form_error.h"

#include <algorithm>

#include "calib/diagnose/select/chosen.h"

namespace armcal {
namespace {

// How much of what `more` explain beyond `fewer` is on other joints than this.
// Chi squared is a sum over joints, whose noise is independent, so that it can
// be told joint by joint; only the baseline connects them.
double DeltaChi2Elsewhere(const GapScreen& screen,
                          const std::vector<GapCandidate>& candidates,
                          const std::vector<int>& fewer,
                          const std::vector<int>& more, int joint) {
  const JointRows before =
      screen.Residuals(screen.Solve(ColumnsOf(candidates, fewer)));
  const JointRows after =
      screen.Residuals(screen.Solve(ColumnsOf(candidates, more)));
  double delta_chi2 = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    if (j == joint) continue;
    delta_chi2 += before[j].squaredNorm() - after[j].squaredNorm();
  }
  return delta_chi2;
}

}  // namespace

double TotalDeltaChi2(const GapScreen& screen,
                      const std::vector<GapCandidate>& candidates,
                      const std::vector<int>& chosen) {
  return screen.Solve(ColumnsOf(candidates, chosen)).delta_chi2;
}

// delta_chi2 of the k-th given all others, each by leaving it out: chi squared
// of the set without it less that of the set. Effects that explain the same
// each have little of it, however much they explain together.
std::vector<double> DeltaChi2OfEach(const GapScreen& screen,
                                    const std::vector<GapCandidate>& candidates,
                                    const std::vector<int>& chosen) {
  const double total = TotalDeltaChi2(screen, candidates, chosen);
  std::vector<double> delta_chi2;
  for (int k = 0; k < static_cast<int>(chosen.size()); ++k) {
    delta_chi2.push_back(
        total - TotalDeltaChi2(screen, candidates, Without(chosen, k)));
  }
  return delta_chi2;
}

// The law of an effect is never exactly that of the robot. If its torque is
// wrong by a share e, it leaves e^2 of its own delta_chi2 as structured
// residual, which other laws of the same joint are the quickest to take up; so
// an addition on that joint has to explain same_joint_share of the strongest
// effect. A wrong form on one joint reaches others through the baseline only,
// and less is asked there. An effect of the whole robot that is added to one of
// a joint is large if it meets the one, or explains other_joint_share on the
// other joints alone.
bool IsLarge(const GapScreen& screen,
             const std::vector<GapCandidate>& candidates,
             const SelectionOptions& options, int strongest, int other,
             const GainOfMore& gain) {
  const int first = candidates[strongest].joint, own = candidates[other].joint;
  const double elsewhere = options.other_joint_share * gain.before;
  if (first >= 0 && own >= 0 && own != first) return gain.gain >= elsewhere;
  if (gain.gain >= options.same_joint_share * gain.before) return true;
  return first >= 0 && own < 0 && gain.gain >= elsewhere &&
         DeltaChi2Elsewhere(screen, candidates, gain.fewer, gain.more, first) >=
             elsewhere;
}

// Two conditions on every member but the strongest: given all the others it
// explains enough, measured by the strongest one's delta_chi2; and what the new
// members explain together beyond `fewer` is enough, measured by all that these
// explain. The second keeps a set from growing by two effects that are large
// only because each undoes the other.
bool AreLarge(const GapScreen& screen,
              const std::vector<GapCandidate>& candidates,
              const SelectionOptions& options, const std::vector<int>& fewer,
              const std::vector<int>& more) {
  const std::vector<double> delta_chi2 =
      DeltaChi2OfEach(screen, candidates, more);
  const auto most = std::max_element(delta_chi2.begin(), delta_chi2.end());
  const int strongest = more[most - delta_chi2.begin()];
  const double before = TotalDeltaChi2(screen, candidates, fewer);
  const double gain = TotalDeltaChi2(screen, candidates, more) - before;
  for (int k = 0; k < static_cast<int>(more.size()); ++k) {
    if (more[k] == strongest) continue;
    const std::vector<int> others = Without(more, k);
    if (!IsLarge(screen, candidates, options, strongest, more[k],
                 {others, more, delta_chi2[k], *most})) {
      return false;
    }
    const bool is_new = std::count(fewer.begin(), fewer.end(), more[k]) == 0;
    if (is_new && !IsLarge(screen, candidates, options, strongest, more[k],
                           {fewer, more, gain, before})) {
      return false;
    }
  }
  return true;
}

}  // namespace armcal
