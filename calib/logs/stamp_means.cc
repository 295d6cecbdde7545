#include "calib/logs/stamp_means.h"

#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd WithMeansOf(const VectorXd& stamps, const VectorXd& t) {
  constexpr double kMean = 1;  // s
  const Index size = t.size();
  VectorXd sum(size + 1);  // of the first k differences
  sum[0] = 0;
  for (Index k = 0; k < size; ++k) sum[k + 1] = sum[k] + stamps[k] - t[k];
  const double step =
      (stamps[size - 1] - stamps[0]) / static_cast<double>(size - 1);
  const Index half = step > 0 ? std::lround(kMean / 2 / step) : size;
  VectorXd moved(size);
  for (Index k = 0; k < size; ++k) {
    const Index begin = std::max<Index>(0, k - half);
    const Index end = std::min(size, k + half + 1);
    moved[k] =
        t[k] + (sum[end] - sum[begin]) / static_cast<double>(end - begin);
    if (k > 0) moved[k] = std::max(moved[k], moved[k - 1]);
  }
  return moved.array() - moved[0];
}

}  // namespace armcal
