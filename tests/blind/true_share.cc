#include "tests/blind/true_share.h"

#include <algorithm>

namespace armcal {

std::optional<double> TrueRemovedPercent(const BlindAnswer& answer,
                                         const BlindAnswer& quiet) {
  const std::optional<double>& refit = quiet.torque.refit;
  const std::optional<double>& after = quiet.torque.after;
  if (!refit || !after || !(*refit > 0)) return std::nullopt;
  const bool same = std::is_permutation(
      answer.effects.begin(), answer.effects.end(), quiet.effects.begin(),
      quiet.effects.end(),
      [](const BlindAnswer::Effect& a, const BlindAnswer::Effect& b) {
        return a.placed == b.placed;
      });
  if (!same) return std::nullopt;
  return 100 * (*refit - *after) / *refit;
}

}  // namespace armcal
