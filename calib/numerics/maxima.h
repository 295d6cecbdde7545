#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// How large the largest of further block maxima may be, as those known say.
// Maxima above their median have an exponential tail (peaks over a threshold,
// Pickands 1975, in Gumbel's domain); that its scale is known from m of them
// only makes what is predicted a Lomax distribution:
//   P(X > median + x) = share (1 + x / (m scale))^-m.
struct MaximaTail {
  double median = 0;
  double scale = 0;
  double exceedances = 0;  // m; 0 where too few are known to say anything
  double share = .5;       // of the maxima that are above the median

  // That the largest of `further` ones is above `value`.
  double Chance(double further, double value) const;
  // What it is above with this probability.
  double Quantile(double further, double probability) const;
};

MaximaTail TailOf(std::vector<double> maxima);
// The same of maxima of which up to a quarter may be something else: the scale
// is told by their upper quartile, as well as a quarter of them tells.
MaximaTail UsualTailOf(std::vector<double> maxima, double fewest);

// What has to stand out from each of several tails.
struct UsualMaximum {
  double further = 0;  // maxima that were looked at
  std::vector<MaximaTail> tails;

  double Chance(double value) const;
  double Quantile(double probability) const;
};

// How probable it is that the largest of as many peaks of what a model lacks is
// as large as this one, its smaller fellows being such peaks, whose sizes have
// an exponential tail, and any number of its larger ones; of each of these
// sizes (any unit, above 0). 1 for those that fewer than four are smaller than.
std::vector<double> ChancesAmongPeaks(const std::vector<double>& sizes);

// The most probable it is that one of these normal deviations, of given
// standard deviations, is as many of these as the largest of `values` is, in so
// many draws of all of them (Bonferroni's bound, at most 1):
//   p = draws n erfc(z / sqrt(2)),  z = max |value| / stddev.
// Deviations of 0 tell nothing.
double ChanceOfLargest(const Eigen::VectorXd& values,
                       const Eigen::VectorXd& stddev, double draws);

}  // namespace armcal
