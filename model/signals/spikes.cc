#include "model/signals/spikes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/simd/kernels.h"
#include "model/text/quantile.h"

namespace armcal {
namespace {

constexpr double kThreshold = 8;  // standard deviations
// Quantiles of |x| for a normal x of deviation 1.
constexpr double kNormal90 = 1.645;
constexpr double kNormal80 = 1.2816;

// The median of three and of five.
double Median(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}
double Median(double a, double b, double c, double d, double e) {
  // Neither the least nor the greatest of a, b, c, d is it.
  const double low = std::max(std::min(a, b), std::min(c, d));
  const double high = std::min(std::max(a, b), std::max(c, d));
  return Median(low, high, e);
}

// The medians of the five samples around each, fewer at the ends.
void LocalMedians(const Eigen::VectorXd& x, Eigen::VectorXd* medians) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd& m = *medians;
  for (Eigen::Index k = 2; k + 2 < n; ++k) {
    m[k] = Median(x[k - 2], x[k - 1], x[k], x[k + 1], x[k + 2]);
  }
  m[0] = x[0];
  m[n - 1] = x[n - 1];
  m[1] = Median(x[0], x[1], x[2]);
  m[n - 2] = Median(x[n - 3], x[n - 2], x[n - 1]);
}

double Percentile(const Eigen::VectorXd& sizes, int percent) {
  return NonnegativeAtRank(sizes.data(), sizes.size(),
                           percent * sizes.size() / 100);
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

// Medians of up to 2 reach + 1 samples around each, fewer at the ends.
Eigen::VectorXd SlidingMedians(const Eigen::VectorXd& x, int reach) {
  constexpr int kMostReach = 15;
  const Eigen::Index n = x.size();
  Eigen::VectorXd medians(n);
  const bool together = reach <= kMostReach && n > 2 * reach;
  if (together) {
    simd::BestKernels().sliding_medians(x.data(), n, reach, medians.data());
  }
  std::vector<double> window;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (together && k >= reach && k < n - reach) continue;
    const Eigen::Index begin = std::max<Eigen::Index>(0, k - reach);
    const Eigen::Index end = std::min(n, k + reach + 1);
    window.assign(x.data() + begin, x.data() + end);
    const auto middle = window.begin() + window.size() / 2;
    std::nth_element(window.begin(), middle, window.end());
    medians[k] = *middle;
  }
  return medians;
}

// The nearest unmarked samples on either side of k, where they are and their
// values: the nearer one's at an end, x[k] where all are marked.
struct Piers {
  Piers(const Eigen::VectorXd& x, Eigen::Index k,
        const Eigen::Array<bool, Eigen::Dynamic, 1>& marked)
      : left(k - 1), right(k + 1) {
    while (left >= 0 && marked[left]) --left;
    while (right < x.size() && marked[right]) ++right;
    const bool has_left = left >= 0, has_right = right < x.size();
    before = has_left ? x[left] : x[has_right ? right : k];
    after = has_right ? x[right] : before;
  }
  Eigen::Index left, right;
  double before, after;
};

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
      LocalMedians(signal, &median);
      size = (signal - median).cwiseAbs();
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
  const Eigen::VectorXd medians = SlidingMedians(x, reach);
  std::vector<double> window;
  Eigen::VectorXd size(n);
  // Marked samples pull on the level and the deviation of those around them.
  for (int pass = 0; pass < 4; ++pass) {
    result.level = medians;
    for (Eigen::Index k = 0, next = 0; k < n; ++k) {
      if (!result.marked[k]) continue;
      next = std::max(next, k - reach);
      for (; next <= std::min(n - 1, k + reach); ++next) {
        result.level[next] =
            UnmarkedMedian(x, next, reach, result.marked, &window);
      }
    }
    size = (x - result.level).cwiseAbs();
    result.deviation = Percentile(size, 80) / kNormal80;
    result.limit = std::max(least, kThreshold * result.deviation);
    if (result.limit <= 0) break;
    const Eigen::Array<bool, Eigen::Dynamic, 1> last = result.marked;
    result.marked = size.array() > result.limit;
    if ((result.marked == last).all()) break;
  }
  return result;
}

double Bridge(const Eigen::VectorXd& x, Eigen::Index k,
              const Eigen::Array<bool, Eigen::Dynamic, 1>& marked) {
  const Piers piers(x, k, marked);
  const double share = static_cast<double>(k - piers.left) /
                       static_cast<double>(piers.right - piers.left);
  return (1 - share) * piers.before + share * piers.after;
}

double NearerEnd(const Eigen::VectorXd& x, Eigen::Index k,
                 const Eigen::Array<bool, Eigen::Dynamic, 1>& marked) {
  const Piers piers(x, k, marked);
  const bool is_before =
      std::abs(x[k] - piers.before) < std::abs(x[k] - piers.after);
  return is_before ? piers.before : piers.after;
}

}  // namespace armcal
