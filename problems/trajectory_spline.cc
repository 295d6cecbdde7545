#include "problems/trajectory_spline.h"

#include <glog/logging.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Weights = Eigen::Matrix<double, 1, TrajectorySpline::kSupport>;

// The B-splines of the given degree, on knots at the whole numbers, that are
// not zero at u from 0 to 1, the one that begins first coming first. The
// recursion is Cox and de Boor's (de Boor 1978, A Practical Guide to Splines,
// ch. X): each degree is a mean of two of the degree before, with weights that
// are not negative, so that nothing cancels.
Weights Cardinal(int degree, double u) {
  Weights b = Weights::Zero();
  b[0] = 1;
  for (int p = 1; p <= degree; ++p) {
    for (int j = p; j >= 0; --j) {
      const double rising = j > 0 ? (u + p - j) * b[j - 1] : 0;
      b[j] = (rising + (1 - u + j) * (j < p ? b[j] : 0)) / p;
    }
  }
  return b;
}

// Derivatives of B-splines of degree p, per knot interval, from those of degree
// p - 1 (or from derivatives of these): B_j' = B_{j-1} - B_j of the lower
// degree (de Boor 1978, ch. X).
Weights Derivative(const Weights& lower) {
  Weights d = -lower;
  d.tail<TrajectorySpline::kSupport - 1>() +=
      lower.head<TrajectorySpline::kSupport - 1>();
  return d;
}

}  // namespace

// Tables the weights of position, velocity and acceleration at every sample.
// Six control points reach a sample, so that the equations of a fit have a band
// of known width and are solved in time linear in the samples.
TrajectorySpline::TrajectorySpline(int samples, double dt, double knot_s) {
  CHECK_GE(samples, kLeastSamples);
  const double duration = (samples - 1) * dt;
  intervals_ = std::max(
      1, static_cast<int>(std::lround(duration / std::max(knot_s, 3 * dt))));
  knot_s_ = duration / intervals_;
  constexpr int kDegree = kSupport - 1;
  for (int k = 0; k < samples; ++k) {
    const double s = k * dt / knot_s_;
    Basis basis;
    basis.first = std::min(intervals_ - 1, static_cast<int>(s));
    const double u = s - basis.first;
    basis.weights.row(0) = Cardinal(kDegree, u);
    basis.weights.row(1) = Derivative(Cardinal(kDegree - 1, u)) / knot_s_;
    basis.weights.row(2) =
        Derivative(Derivative(Cardinal(kDegree - 2, u))) / (knot_s_ * knot_s_);
    basis_.push_back(basis);
  }
}

MatrixXd TrajectorySpline::Evaluate(const MatrixXd& points, int order) const {
  MatrixXd x(size(), points.cols());
  for (int k = 0; k < size(); ++k) {
    x.row(k) = basis_[k].weights.row(order) *
               points.middleRows<kSupport>(basis_[k].first);
  }
  return x;
}

// Least squares of the positions alone, by the normal equations B'B c = B' q.
// They are banded, and B-splines with three samples and more per knot interval
// are well conditioned whatever their number (de Boor 1978). So B'B may square
// the condition number, which rules normal equations out elsewhere.
MatrixXd TrajectorySpline::Fit(const MatrixXd& samples) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < size(); ++k) {
    for (int a = 0; a < kSupport; ++a) {
      entries.emplace_back(k, basis_[k].first + a, basis_[k].weights(0, a));
    }
  }
  Eigen::SparseMatrix<double> B(size(), num_points());
  B.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(
      B.transpose() * B);
  CHECK_EQ(solver.info(), Eigen::Success);
  return solver.solve(B.transpose() * samples);
}

}  // namespace armcal
