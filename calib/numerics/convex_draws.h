#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace armcal {

// Where a line lies within a convex set: at + t * along for t in here.
struct LineRange {
  double least, most;
};
// Of a line through a point of the set.
using RangeOnLine = std::function<LineRange(const Eigen::VectorXd& at,
                                            const Eigen::VectorXd& along)>;

// Draws from a normal distribution of this mean and covariance as far as it
// lies in a convex set, of which `start` is a point, or `mean` where that is
// empty; a draw per column, the same for the same seed. A mean outside the set
// is what a peak is that the set cuts off.
//
// A Markov chain that moves along one line after the other (hit-and-run: Smith
// 1984; Belisle, Romeijn and Smith 1993): on a line the distribution is a
// normal one between two ends, which is drawn from exactly, so that nothing has
// to be tuned. Lines are the principal axes of what a first part of the chain
// visited, in coordinates in which the covariance is 1: directions that the set
// holds narrower than the covariance does so have lines of their own.
Eigen::MatrixXd DrawWithin(const Eigen::VectorXd& mean,
                           const Eigen::MatrixXd& covariance,
                           const RangeOnLine& range, int count, uint64_t seed,
                           const Eigen::VectorXd& start = {});

}  // namespace armcal
