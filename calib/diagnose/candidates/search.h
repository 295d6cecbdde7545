#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Frequencies w (rad per unit of `place`) between `low` and `high` at which the
// residual has the highest peaks of |sum_k r_k exp(-i w place_k)|^2, at most
// `count`, the highest first.
std::vector<double> PeakFrequencies(const Eigen::VectorXd& residual,
                                    const Eigen::VectorXd& place, double low,
                                    double high, int count);

// The amplitude of a signal (at times t, s) at a frequency (Hz), in its unit.
double AmplitudeAt(const Eigen::VectorXd& signal, const Eigen::VectorXd& t,
                   double frequency);

// By how much the power of a signal (at times t, s) at a frequency (Hz) exceeds
// that around it, its mean from .2 to 1 Hz to both sides.
double PowerOverNeighbours(const Eigen::VectorXd& signal,
                           const Eigen::VectorXd& t, double frequency);

// A stretch of time.
struct TimeWindow {
  double centre;        // s
  double duration;      // s
  double strength = 0;  // chi^2 of its mean, were the residual white
};
// Windows in which whitened residuals (samples x n, at times t) have a mean
// that noise would not have, at most `count` of each duration, the strongest
// first. *searched: how many were looked at.
std::vector<TimeWindow> StrongWindows(const Eigen::MatrixXd& residual,
                                      const Eigen::VectorXd& t,
                                      const std::vector<double>& durations,
                                      int count, int* searched);

}  // namespace armcal
