#include "calib/inspect/equal_rows.h"

#include <algorithm>
#include <cmath>

namespace armcal {

std::vector<EqualRows> RunsOfEqualRows(const Eigen::VectorXd& x,
                                       const std::vector<bool>& counts) {
  std::vector<EqualRows> runs;
  const auto rows = static_cast<int>(x.size());
  for (int k = 0; k < rows;) {
    EqualRows run{k, k + 1};
    bool any = counts[k];
    for (; run.end < rows && x[run.end] == x[k]; ++run.end) {
      run.repeats += counts[run.end] && counts[run.end - 1];
      any = any || counts[run.end];
    }
    if (any) runs.push_back(run);
    k = run.end;
  }
  return runs;
}

std::vector<EqualRows> TooLongForChance(std::vector<EqualRows> runs,
                                        double nats) {
  constexpr size_t kMostRuns = 8;
  std::sort(runs.begin(), runs.end(),
            [](const auto& a, const auto& b) { return a.repeats > b.repeats; });
  const double log_m = std::log(static_cast<double>(runs.size()));
  size_t count = 0;
  for (size_t k = 0; k < std::min(kMostRuns, runs.size()); ++k) {
    const int next = k + 1 < runs.size() ? runs[k + 1].repeats : 0;
    const double against =
        log_m * (runs[k].repeats / std::max(1., 1. * next) - 1);
    if (against > nats) count = k + 1;
  }
  runs.resize(count);
  return runs;
}

}  // namespace armcal
