#pragma once

#include <cstddef>
#include <vector>

namespace armcal {

// A residual of r noise deviations, brought to where Huber's loss begins to
// doubt it: so that one outlier does not decide a statistic.
double Clipped(double r);

// The robust spread of residuals, given in units of a first guess, in one pass
// and constant memory; their order does not matter.
class ResidualSpread {
 public:
  ResidualSpread();

  void Add(double r);
  // 1.4826 times the median of |r|.
  double Value() const;
  long count() const { return count_; }

 private:
  std::vector<long> histogram_;  // of log |r|
  long count_ = 0;
};

// Also their autocorrelation at a lag.
class ResidualStatistics {
 public:
  explicit ResidualStatistics(int lag = 1);

  void Add(double r);
  void Break();  // the next residual does not follow the last
  double RobustSpread() const { return spread_.Value(); }
  double Autocorrelation() const;
  long count() const { return spread_.count(); }
  // How many residuals are beyond 2.7, where Huber's weight is below 1/2.
  long outliers() const { return outliers_; }

 private:
  ResidualSpread spread_;
  long outliers_ = 0;
  double product_ = 0, square_ = 0;
  // As many residuals as the lag, the oldest of which is replaced by the next.
  std::vector<double> recent_;
  size_t num_recent_ = 0, oldest_ = 0;
};

}  // namespace armcal
