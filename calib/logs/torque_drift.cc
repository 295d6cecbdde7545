#include "calib/logs/torque_drift.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kKnots = 3;  // s

// Solves a symmetric tridiagonal positive definite system for the columns of b.
MatrixXd SolveTridiagonal(VectorXd diagonal, const VectorXd& next, MatrixXd b) {
  const Eigen::Index n = diagonal.size();
  for (Eigen::Index k = 1; k < n; ++k) {
    const double share = next[k - 1] / diagonal[k - 1];
    diagonal[k] -= share * next[k - 1];
    b.row(k) -= share * b.row(k - 1);
  }
  for (Eigen::Index k = n; k-- > 0;) {
    if (k + 1 < n) b.row(k) -= next[k] * b.row(k + 1);
    b.row(k) /= diagonal[k];
  }
  return b;
}

}  // namespace

TorqueDrift::TorqueDrift(const VectorXd& times) {
  if (times.size() == 0) {
    knots_ = 0;
    return;
  }
  const double duration = times[times.size() - 1] - times[0];
  const int pieces = std::max(1, static_cast<int>(duration / kKnots));
  knots_ = pieces + 1;
  place_ = (times.array() - times[0]) * (duration > 0 ? pieces / duration : 0);
}

MatrixXd TorqueDrift::Without(const MatrixXd& x,
                              const VectorXd& weights) const {
  // As much as this many rows, about half of those between two knots, want
  // knots to be as high as their neighbours: the level walks by less from one
  // to the next than the rows there are uncertain, and torques that drift are
  // still to be seen.
  constexpr double kTension = 30;
  CHECK_EQ(x.rows(), place_.size());
  if (knots_ == 0) return x;
  VectorXd diagonal = VectorXd::Constant(knots_, 1e-12);
  VectorXd next = VectorXd::Constant(knots_ - 1, -kTension);
  diagonal.head(knots_ - 1).array() += kTension;
  diagonal.tail(knots_ - 1).array() += kTension;
  MatrixXd right = MatrixXd::Zero(knots_, x.cols());
  const auto piece = [&](Eigen::Index k) {
    return std::min(static_cast<int>(place_[k]), knots_ - 2);
  };
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    const double w = weights[k];
    if (w == 0) continue;
    const int at = piece(k);
    const double b = place_[k] - at, a = 1 - b;
    diagonal[at] += w * a * a;
    diagonal[at + 1] += w * b * b;
    next[at] += w * a * b;
    right.row(at) += w * a * x.row(k);
    right.row(at + 1) += w * b * x.row(k);
  }
  const MatrixXd level = SolveTridiagonal(diagonal, next, right);
  MatrixXd without = x;
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    const int at = piece(k);
    const double b = place_[k] - at;
    without.row(k) -= (1 - b) * level.row(at) + b * level.row(at + 1);
  }
  return without;
}

}  // namespace armcal
