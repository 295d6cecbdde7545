#include "model/spikes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace armcal {
namespace {

constexpr double kThreshold = 8;     // standard deviations
constexpr double kNormal90 = 1.645;  // of |x| for a normal x of deviation 1

// The median of the five samples around k, fewer at the ends.
double LocalMedian(const Eigen::VectorXd& x, Eigen::Index k) {
  const Eigen::Index reach = std::min<Eigen::Index>({2, k, x.size() - 1 - k});
  std::array<double, 5> window;
  const auto end =
      std::copy_n(x.data() + k - reach, 2 * reach + 1, window.begin());
  std::nth_element(window.begin(), window.begin() + reach, end);
  return window[reach];
}

double Percentile90(const Eigen::VectorXd& x) {
  std::vector<double> sorted(x.data(), x.data() + x.size());
  const auto at = sorted.begin() + 9 * x.size() / 10;
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

}  // namespace

Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> RemoveSpikes(
    Eigen::MatrixXd* x) {
  const Eigen::Index n = x->rows();
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> replaced =
      Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>::Constant(n, x->cols(),
                                                                   false);
  if (n < 20) return replaced;
  Eigen::VectorXd median(n), size(n);
  for (Eigen::Index c = 0; c < x->cols(); ++c) {
    double limit = 0;
    // Again on what is left: spikes close together hide each other.
    for (int pass = 0; pass < 3; ++pass) {
      const Eigen::VectorXd signal = x->col(c);
      for (Eigen::Index k = 0; k < n; ++k) {
        median[k] = LocalMedian(signal, k);
        size[k] = std::abs(signal[k] - median[k]);
      }
      if (pass == 0) limit = kThreshold * Percentile90(size) / kNormal90;
      bool found = false;
      for (Eigen::Index k = 0; limit > 0 && k < n; ++k) {
        if (size[k] <= limit) continue;
        (*x)(k, c) = median[k];
        replaced(k, c) = found = true;
      }
      if (!found) break;
    }
  }
  return replaced;
}

}  // namespace armcal
