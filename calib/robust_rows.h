#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

namespace armcal {

// Huber's loss at 1.345 standard deviations (95 % efficient for normal errors).
struct Huber {
  static constexpr double kThreshold = 1.345;
  // The factor on a residual of r standard deviations in the normal equations.
  static double Weight(double r);
  // Derivative of the score: 1 inside, 0 outside.
  static bool Inside(double r);
};

// Statistics of residuals in one pass and constant memory: their robust spread
// and autocorrelation at a lag. Residuals are given in units of a first guess.
class ResidualStatistics {
 public:
  explicit ResidualStatistics(int lag = 1);

  void Add(double r);
  void Break();  // the next residual does not follow the last
  // 1.4826 times the median of |r|.
  double RobustSpread() const;
  double Autocorrelation() const;
  long count() const { return count_; }
  // How many residuals Huber's loss weighs below 1/2.
  long outliers() const { return outliers_; }

 private:
  std::vector<long> histogram_;  // of log |r|
  long count_ = 0, outliers_ = 0;
  double product_ = 0, square_ = 0;
  size_t lag_;
  std::deque<double> recent_;
};

}  // namespace armcal
