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

}  // namespace armcal
