#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// One-sided power spectral densities of several signals sampled every dt
// seconds (Welch 1967): periodograms of half-overlapping Hann windows,
// averaged. Stretches shorter than a window do not count.
class PowerSpectrum {
 public:
  PowerSpectrum(int num_signals, double dt, int window = 512);

  void Add(const Eigen::VectorXd& values);
  void Break();  // the next sample does not follow the last
  bool empty() const { return windows_ == 0; }
  Eigen::VectorXd Frequencies() const;  // Hz, window / 2 + 1 entries
  // Frequency x signal, squares of the signals' units per Hz.
  Eigen::MatrixXd Density() const;

 private:
  void AddWindow();

  double dt_;
  int window_;
  Eigen::VectorXd hann_;
  Eigen::MatrixXd recent_;  // window x signal
  int filled_ = 0;
  Eigen::MatrixXd sums_;
  long windows_ = 0;
};

}  // namespace armcal
