#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// How a signal is continued beyond its ends while it is filtered.
enum class Ends {
  kReflect,  // odd reflection: for noisy signals; bends what curves at the end
  // The cubic that fits the last period of the cutoff best: for motion, which
  // it keeps curving. A cubic passes the filter unchanged.
  kExtrapolate,
};

// Zero-phase low pass of each column of x (samples in rows): a Butterworth
// filter of order 4 run forwards and backwards, so that the gain is 1/2 (-6 dB)
// at cutoff_hz. A cutoff at or above half the sample rate returns x unchanged.
Eigen::MatrixXd ZeroPhaseLowPass(const Eigen::MatrixXd& x, double sample_rate,
                                 double cutoff_hz, Ends ends = Ends::kReflect);

// The same of columns of one length wherever they lie, `count` rows of it
// alone: `first` and every `stride`-th from there on.
Eigen::MatrixXd ThinnedLowPass(const std::vector<const Eigen::VectorXd*>& x,
                               double sample_rate, double cutoff_hz, int first,
                               int stride, int count);

// Seconds after which the filter has forgotten its input to 1e-9.
double LowPassMemory(double cutoff_hz);

// d/dt of each column by central differences of order 4 (one-sided at the
// ends, order 2); step dt in s.
Eigen::MatrixXd Differentiate(const Eigen::MatrixXd& x, double dt);

}  // namespace armcal
