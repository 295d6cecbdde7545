#include "calib/diagnose/select/maxima_tail.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

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

MaximaTail UsualTailOf(std::vector<double> maxima) {
  MaximaTail tail;
  if (maxima.size() < Limits().fewest_blocks) return tail;
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

}  // namespace armcal
