#include "calib/numerics/block_bootstrap.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace armcal {
namespace {

constexpr int kBootstrapDraws = 2000;
constexpr double kCorrelationTimes = 2;  // per block

// Midranks less their mean.
std::vector<double> CenteredRanks(const std::vector<double>& series) {
  std::vector<double> sorted = series;
  std::sort(sorted.begin(), sorted.end());
  const double mean = (static_cast<double>(series.size()) - 1) / 2;
  std::vector<double> ranks;
  for (const double x : series) {
    const auto [first, last] =
        std::equal_range(sorted.begin(), sorted.end(), x);
    const auto below = static_cast<double>(first - sorted.begin());
    const auto equal = static_cast<double>(last - first);
    ranks.push_back(below + (equal - 1) / 2 - mean);
  }
  return ranks;
}

// The sum of products with the series `lag` later.
double Product(const std::vector<double>& x, size_t lag) {
  double sum = 0;
  for (size_t k = lag; k < x.size(); ++k) sum += x[k] * x[k - lag];
  return sum;
}

// The share of draws that is left out at either end of an interval of 95 %.
double TailShare(double blocks) {
  const double t =
      quantile(boost::math::students_t(blocks - 1), 0.975);  // positive
  return cdf(boost::math::normal(), -t * std::sqrt(blocks / (blocks - 1)));
}

}  // namespace

double CorrelationTime(const std::vector<double>& series) {
  const std::vector<double> ranks = CenteredRanks(series);
  const double variance = Product(ranks, 0);
  if (!(variance > 0)) return 1;
  double time = -1;
  for (size_t lag = 0; lag + 1 < ranks.size(); lag += 2) {
    const double pair = Product(ranks, lag) + Product(ranks, lag + 1);
    if (pair <= 0) break;
    time += 2 * pair / variance;
  }
  return std::max(1.0, time);
}

int BootstrapBlock(int size, double correlation_time) {
  const double least = std::round(std::cbrt(size));
  const double block =
      std::max(least, std::ceil(kCorrelationTimes * correlation_time));
  return static_cast<int>(std::min<double>(block, size));
}

BootstrapInterval BlockBootstrap(
    int size, int block, std::uint64_t seed,
    const std::function<double(const std::vector<int>&)>& statistic) {
  std::mt19937_64 random(seed);
  std::vector<int> chosen(size);
  std::vector<double> draws;
  for (int draw = 0; draw < kBootstrapDraws; ++draw) {
    for (int k = 0; k < size; ++k) {
      chosen[k] = k % block == 0 ? static_cast<int>(random() % size)
                                 : (chosen[k - 1] + 1) % size;
    }
    const double value = statistic(chosen);
    draws.push_back(std::isnan(value) ? std::numeric_limits<double>::infinity()
                                      : value);
  }
  std::sort(draws.begin(), draws.end());
  const double blocks = std::max(2.0, static_cast<double>(size) / block);
  const int tail = static_cast<int>(TailShare(blocks) * kBootstrapDraws);
  return {draws[tail], draws[kBootstrapDraws - 1 - tail]};
}

}  // namespace armcal
