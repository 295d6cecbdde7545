#include "calib/numerics/maxima.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armcal {
namespace {

// log of k! for k up to n.
std::vector<double> LogFactorials(size_t n) {
  std::vector<double> table(n + 1);
  for (size_t k = 0; k <= n; ++k) {
    table[k] = std::lgamma(static_cast<double>(k) + 1);
  }
  return table;
}

}  // namespace

// Each of `further` maxima is above the median with the probability `share` and
// beyond x of it with (1 + x / (m scale))^-m, the predictive distribution of an
// exponential tail whose scale m exceedances tell. The expected number of those
// that are beyond bounds the probability of one.
double MaximaTail::Chance(double further, double value) const {
  if (exceedances == 0 || value <= median) return 1;
  if (scale == 0) return 0;
  const double beyond = (value - median) / (exceedances * scale);
  return std::min(1., further * share * std::pow(1 + beyond, -exceedances));
}

double MaximaTail::Quantile(double further, double probability) const {
  if (exceedances == 0) return std::numeric_limits<double>::infinity();
  const double m = exceedances;
  return median +
         m * scale * (std::pow(further * share / probability, 1 / m) - 1);
}

// The scale of an exponential tail is the mean of its exceedances over the
// threshold, here the median: maximum likelihood for that tail, and as many of
// them as there are say how well it is known.
MaximaTail TailOf(std::vector<double> maxima) {
  MaximaTail tail;
  if (maxima.size() < 2) return tail;
  std::sort(maxima.begin(), maxima.end());
  tail.median = maxima[(maxima.size() - 1) / 2];
  double sum = 0;
  int above = 0;
  for (const double x : maxima) {
    if (x <= tail.median) continue;
    sum += x - tail.median;
    ++above;
  }
  tail.exceedances = std::max(1, above);
  tail.scale = sum / tail.exceedances;
  tail.share = static_cast<double>(above) / maxima.size();
  return tail;
}

MaximaTail UsualTailOf(std::vector<double> maxima, double fewest) {
  MaximaTail tail;
  if (maxima.size() < fewest) return tail;
  std::sort(maxima.begin(), maxima.end());
  const size_t last = maxima.size() - 1;
  tail.median = maxima[last / 2];
  // Half of an exponential tail's exceedances are above log 2 scales.
  tail.scale = (maxima[3 * last / 4] - tail.median) / std::log(2.);
  tail.exceedances = maxima.size() / 4.;
  return tail;
}

double UsualMaximum::Chance(double value) const {
  double chance = 0;
  for (const MaximaTail& tail : tails) {
    chance = std::max(chance, tail.Chance(further, value));
  }
  return chance;
}

double UsualMaximum::Quantile(double probability) const {
  double largest = 0;
  for (const MaximaTail& tail : tails) {
    largest = std::max(largest, tail.Quantile(further, probability));
  }
  return largest;
}

// What peaks have above a threshold, the smallest one's size, is exponential
// (the generalized Pareto law of shape 0, Pickands 1975). Where m of them with
// the sum S are all that is known of its mean, whose logarithm could be any
// before, k more have as much as x above it, all of them, with the probability
//   (1 + k x / S)^-m,
// Lomax's law for k = 1, and any k of m + k with at most (m + k)! / (m! k!)
// times that (Bonferroni). A peak is asked against those below it, by itself
// and with one, two, .. of those above it, any of which may be a peak as it is
// or none: the largest of these chances is its own (closed testing, Marcus,
// Peritz and Gabriel 1976). It is no likelier than those below it, so that
// several which stand out do not hide each other; that k of them do is one
// question among others, of which it has the share 2^-k (weighted Bonferroni,
// Genovese, Roeder and Wasserman 2006).
std::vector<double> ChancesAmongPeaks(const std::vector<double>& sizes) {
  constexpr int kFewest = 3;  // above the threshold, that tell a mean
  std::vector<double> chances(sizes.size(), 1);
  if (sizes.empty()) return chances;
  const double threshold = *std::min_element(sizes.begin(), sizes.end());
  const std::vector<double> log_factorial = LogFactorials(sizes.size());
  for (size_t i = 0; i < sizes.size(); ++i) {
    double sum = 0;
    int below = -1, out = 0;  // the smallest is the threshold's
    for (const double size : sizes) {
      if (!(size < sizes[i])) {
        ++out;
        continue;
      }
      sum += size - threshold;
      ++below;
    }
    if (below < kFewest || !(sum > 0)) continue;
    double log_chance = -std::numeric_limits<double>::infinity();
    for (int k = 1; k <= out; ++k) {
      log_chance = std::max(
          log_chance, log_factorial[below + k] - log_factorial[k] -
                          log_factorial[below] -
                          below * std::log1p(k * (sizes[i] - threshold) / sum));
    }
    chances[i] = std::min(1., std::exp(log_chance + out * std::log(2.)));
  }
  const std::vector<double> alone = chances;
  for (size_t i = 0; i < sizes.size(); ++i) {
    for (size_t k = 0; k < sizes.size(); ++k) {
      if (sizes[k] < sizes[i]) chances[i] = std::min(chances[i], alone[k]);
    }
  }
  return chances;
}

double ChanceOfLargest(const Eigen::VectorXd& values,
                       const Eigen::VectorXd& stddev, double draws) {
  double largest = 0;
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    if (!(stddev[j] > 0)) continue;
    largest = std::max(largest, std::abs(values[j]) / stddev[j]);
  }
  const double count = draws * static_cast<double>(values.size());
  return std::min(1., count * std::erfc(largest / std::sqrt(2.)));
}

}  // namespace armcal
