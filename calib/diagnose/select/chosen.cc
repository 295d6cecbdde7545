#include "calib/diagnose/select/chosen.h"

namespace armcal {

std::vector<int> Without(std::vector<int> chosen, int k) {
  if (k >= 0) chosen.erase(chosen.begin() + k);
  return chosen;
}

std::vector<int> ColumnsOf(const std::vector<GapCandidate>& candidates,
                           const std::vector<int>& chosen) {
  std::vector<int> columns;
  for (const int c : chosen) {
    const auto& own = candidates[c].columns;
    columns.insert(columns.end(), own.begin(), own.end());
  }
  return columns;
}

// The coefficients of the screen's columns are in units of the candidate's
// `size`.
std::vector<GapCandidate> FittedTo(const GapScreen& screen,
                                   const std::vector<GapCandidate>& candidates,
                                   const std::vector<int>& which) {
  std::vector<GapCandidate> fitted;
  const GapScreen::Fit fit = screen.Solve(ColumnsOf(candidates, which));
  int at = 0;
  for (const int c : which) {
    fitted.push_back(candidates[c]);
    GapCandidate& effect = fitted.back();
    for (size_t l = 0; l < effect.linear.size(); ++l) {
      effect.p[effect.linear[l]] = fit.coefficients[at++] * effect.size[l];
    }
  }
  return fitted;
}

bool IsPossible(const GapCandidate& fitted, const Robot& robot,
                const MotionScale& scale) {
  const EffectSite site = {&robot, fitted.joint, &scale};
  return !fitted.effect->plausible ||
         fitted.effect->plausible(site,
                                  EstimatesOf(*fitted.effect, site, fitted.p));
}

}  // namespace armcal
