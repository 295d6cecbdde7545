#include "calib/diagnose/select/form_error.h"

#include <algorithm>

#include "calib/diagnose/select/chosen.h"

namespace armcal {
namespace {

// How much of what `more` explain beyond `fewer` is on other joints than this.
double DropElsewhere(const GapScreen& screen,
                     const std::vector<GapCandidate>& candidates,
                     const std::vector<int>& fewer,
                     const std::vector<int>& more, int joint) {
  const GapScreen::Fit before = screen.Solve(ColumnsOf(candidates, fewer));
  const GapScreen::Fit after = screen.Solve(ColumnsOf(candidates, more));
  double drop = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    if (j == joint) continue;
    drop += screen.Residual(j, before).squaredNorm() -
            screen.Residual(j, after).squaredNorm();
  }
  return drop;
}

}  // namespace

double TotalDrop(const GapScreen& screen,
                 const std::vector<GapCandidate>& candidates,
                 const std::vector<int>& chosen) {
  return screen.Solve(ColumnsOf(candidates, chosen)).drop;
}

std::vector<double> Drops(const GapScreen& screen,
                          const std::vector<GapCandidate>& candidates,
                          const std::vector<int>& chosen) {
  const double total = TotalDrop(screen, candidates, chosen);
  std::vector<double> drops;
  for (int k = 0; k < static_cast<int>(chosen.size()); ++k) {
    drops.push_back(total - TotalDrop(screen, candidates, Without(chosen, k)));
  }
  return drops;
}

bool IsLarge(const GapScreen& screen,
             const std::vector<GapCandidate>& candidates,
             const SelectionOptions& options, int strongest, int other,
             const Gain& gain) {
  const int first = candidates[strongest].joint, own = candidates[other].joint;
  const double elsewhere = options.other_joint_share * gain.before;
  if (first >= 0 && own >= 0 && own != first) return gain.gain >= elsewhere;
  if (gain.gain >= options.same_joint_share * gain.before) return true;
  return first >= 0 && own < 0 && gain.gain >= elsewhere &&
         DropElsewhere(screen, candidates, gain.fewer, gain.more, first) >=
             elsewhere;
}

bool AreLarge(const GapScreen& screen,
              const std::vector<GapCandidate>& candidates,
              const SelectionOptions& options, const std::vector<int>& fewer,
              const std::vector<int>& more) {
  const std::vector<double> drops = Drops(screen, candidates, more);
  const auto most = std::max_element(drops.begin(), drops.end());
  const int strongest = more[most - drops.begin()];
  const double before = TotalDrop(screen, candidates, fewer);
  const double gain = TotalDrop(screen, candidates, more) - before;
  for (int k = 0; k < static_cast<int>(more.size()); ++k) {
    if (more[k] == strongest) continue;
    const std::vector<int> others = Without(more, k);
    if (!IsLarge(screen, candidates, options, strongest, more[k],
                 {others, more, drops[k], *most})) {
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
