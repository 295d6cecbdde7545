#pragma once

#include <Eigen/Core>

namespace armcal {

// Whether residuals of unit variance are white where it matters for estimates,
// that is over long times: the variance ratio of Lo and MacKinlay (1988), sums
// over blocks of samples against what white noise would make of them, one
// sided. Columns of Add() are joints; a sample of 0 in all of a block's rows
// is none.
class ResidualWhiteness {
 public:
  explicit ResidualWhiteness(int num_joints);

  // Residuals of one stretch (samples x joints), in blocks of `block` samples.
  void Add(const Eigen::MatrixXd& residuals, int block);
  // Mean square of the blocks' sums over that of white noise, all joints and
  // the worst.
  double ratio() const;
  double worst_ratio() const;
  // False where one of the ratios is above 1 by more than 4 standard
  // deviations.
  bool IsWhite() const;

 private:
  Eigen::ArrayXd sums_;   // of squared block sums
  Eigen::ArrayXd white_;  // what white noise makes of them
  Eigen::ArrayXd blocks_;
};

}  // namespace armcal
