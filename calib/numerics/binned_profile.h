#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Several signals over one coordinate, in one pass and bounded memory: their
// sums and squares in bins of equal width. The width, a power of two, doubles
// whenever there would be more than `most_bins` bins, so that the bins depend
// on the samples alone and not on their order.
class BinnedProfile {
 public:
  BinnedProfile(int num_signals, int most_bins);

  // Both finite.
  void Add(double x, const Eigen::VectorXd& values);

  bool empty() const { return samples_.empty(); }
  int size() const { return static_cast<int>(samples_.size()); }
  double width() const { return width_; }
  double begin() const { return static_cast<double>(first_) * width_; }
  long samples(int bin) const { return samples_[bin]; }
  // Of a bin that has samples.
  Eigen::VectorXd Mean(int bin) const;
  Eigen::VectorXd Rms(int bin) const;

 private:
  void Halve();

  int num_signals_, most_bins_;
  double width_;
  long first_ = 0;  // bin k holds [(first + k) width, (first + k + 1) width)
  std::vector<long> samples_;
  std::vector<Eigen::VectorXd> sums_, squares_;
};

}  // namespace armcal
