#include "model/spikes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace armcal {
namespace {

constexpr double kThreshold = 8;  // standard deviations
// Quantiles of |x| for a normal x of deviation 1.
constexpr double kNormal90 = 1.645;
constexpr double kNormal80 = 1.2816;

// The median of the five samples around k, fewer at the ends.
double LocalMedian(const Eigen::VectorXd& x, Eigen::Index k) {
  const Eigen::Index reach = std::min<Eigen::Index>({2, k, x.size() - 1 - k});
  std::array<double, 5> window;
  const auto end =
      std::copy_n(x.data() + k - reach, 2 * reach + 1, window.begin());
  std::nth_element(window.begin(), window.begin() + reach, end);
  return window[reach];
}

double Percentile(const Eigen::VectorXd& x, int percent) {
  std::vector<double> sorted(x.data(), x.data() + x.size());
  const auto at = sorted.begin() + percent * x.size() / 100;
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

// The median of sample k, unless marked, and the nearest `reach` unmarked ones
// on either side of it.
double UnmarkedMedian(const Eigen::VectorXd& x, Eigen::Index k, int reach,
                      const Eigen::Array<bool, Eigen::Dynamic, 1>& marked,
                      std::vector<double>* window) {
  window->clear();
  for (Eigen::Index j = k, count = 0; j >= 0 && count <= reach; --j) {
    if (!marked[j]) window->push_back(x[j]);
    count += !marked[j] || j == k;
  }
  for (Eigen::Index j = k + 1, count = 0; j < x.size() && count < reach; ++j) {
    if (!marked[j]) window->push_back(x[j]), ++count;
  }
  if (window->empty()) return x[k];
  const auto middle = window->begin() + window->size() / 2;
  std::nth_element(window->begin(), middle, window->end());
  return *middle;
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
      if (pass == 0) limit = kThreshold * Percentile(size, 90) / kNormal90;
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

Outlying FindOutlying(const Eigen::VectorXd& x, int reach, double least) {
  const Eigen::Index n = x.size();
  Outlying result;
  result.marked.setConstant(n, false);
  result.level = x;
  if (n < 20) return result;
  std::vector<double> window;
  Eigen::VectorXd size(n);
  // Marked samples pull on the level and the deviation of those around them.
  for (int pass = 0; pass < 4; ++pass) {
    for (Eigen::Index k = 0; k < n; ++k) {
      result.level[k] = UnmarkedMedian(x, k, reach, result.marked, &window);
    }
    size = (x - result.level).cwiseAbs();
    result.deviation = Percentile(size, 80) / kNormal80;
    const double limit = std::max(least, kThreshold * result.deviation);
    if (limit <= 0) break;
    const Eigen::Array<bool, Eigen::Dynamic, 1> last = result.marked;
    result.marked = size.array() > limit;
    if ((result.marked == last).all()) break;
  }
  return result;
}

double Bridge(const Eigen::VectorXd& x, Eigen::Index k,
              const Eigen::Array<bool, Eigen::Dynamic, 1>& marked) {
  Eigen::Index left = k - 1, right = k + 1;
  while (left >= 0 && marked[left]) --left;
  while (right < x.size() && marked[right]) ++right;
  const bool has_right = right < x.size();
  if (left < 0) return has_right ? x[right] : x[k];
  if (!has_right) return x[left];
  const double share =
      static_cast<double>(k - left) / static_cast<double>(right - left);
  return (1 - share) * x[left] + share * x[right];
}

}  // namespace armcal
