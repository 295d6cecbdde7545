#include "calib/refine/link_start.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "problems/inertial_coordinates.h"

namespace armcal {
namespace {

using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTermBarrier = 1e-4;
constexpr int kMaxSteps = 500;

// The ten entries of a symmetric matrix, those off the diagonal times sqrt(2),
// so that |Vec(S)| is the Frobenius norm.
Vector10d Vec(const Matrix4d& S) {
  Vector10d v;
  int k = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j <= i; ++j) v[k++] = S(i, j) * (i == j ? 1 : std::sqrt(2));
  }
  return v;
}

Matrix4d Congruence(const Matrix4d& C, const Matrix4d& P) {  // C^-1 P C^-T
  const auto L = C.triangularView<Eigen::Lower>();
  const Matrix4d half = L.solve(P).transpose();
  return L.solve(half);
}

// The cost is quadratic plus -log det of matrices that are linear in x, which
// is self-concordant: damped Newton steps converge from any point inside, in a
// number that depends neither on scales nor on how near the boundary is (Boyd &
// Vandenberghe 2004, Convex Optimization, 9.6 and 11.5).
class Interior {
 public:
  Interior(const MatrixXd& R, const VectorXd& z,
           const std::vector<TermRange>& terms, const VectorXd& x)
      : R_(R), z_(z), terms_(terms), x_(x), links_(NumLinks()) {
    for (int i = 0; i < links_; ++i) {
      P_0_.push_back(PseudoInertia(Link(x_, i)));
    }
    for (size_t t = 0; t < terms_.size(); ++t) {
      double& value = x_[10 * links_ + t];
      // Far enough from 0 for the first step; R tells the scale.
      const double scale = 1 / std::max(1e-9, R_.col(10 * links_ + t).norm());
      if (terms_[t] == TermRange::kPositive) value = std::max(value, scale);
    }
  }

  const VectorXd& x() const { return x_; }
  double DataCost() const { return (R_ * x_ - z_).squaredNorm(); }
  // One Newton step for the prior's weight; the decrease of the cost it
  // promised.
  double Step(double weight);

 private:
  int NumLinks() const {
    return static_cast<int>(x_.size() - terms_.size()) / 10;
  }
  static Vector10d Link(const VectorXd& x, int i) {
    return x.segment<10>(10 * i);
  }
  double Cost(const VectorXd& x, double weight) const;
  double LongestStep(const VectorXd& step) const;

  const MatrixXd& R_;
  const VectorXd& z_;
  const std::vector<TermRange>& terms_;
  VectorXd x_;
  int links_;
  std::vector<Matrix4d> P_0_;
};

// |R x - z|^2 + 2 weight sum (tr X - log det X - 4) - 2 kTermBarrier sum
// log(term), with log det X = 2 sum log L_ii by Cholesky. It is asked for
// inside the boundary alone, where the factor exists (LongestStep).
double Interior::Cost(const VectorXd& x, double weight) const {
  double cost = (R_ * x - z_).squaredNorm();
  for (int i = 0; i < links_; ++i) {
    const Matrix4d A = P_0_[i].llt().matrixL();
    const Matrix4d X = Congruence(A, PseudoInertia(Link(x, i)));
    const Matrix4d L = X.llt().matrixL();
    cost += 2 * weight * (X.trace() - 4 - 2 * L.diagonal().array().log().sum());
  }
  for (size_t t = 0; t < terms_.size(); ++t) {
    if (terms_[t] != TermRange::kPositive) continue;
    cost -= 2 * kTermBarrier * std::log(x[10 * links_ + t]);
  }
  return cost;
}

// How much of a step to take: all of it, or 0.9 of the way to the boundary
// where that is less. Along a step, P(V) = C C' becomes C (1 + t D) C', which
// is positive until 1 + t lambda = 0 for the least eigenvalue lambda of D.
double Interior::LongestStep(const VectorXd& step) const {
  double fastest = 0.9;
  for (int i = 0; i < links_; ++i) {
    const Matrix4d C = PseudoInertia(Link(x_, i)).llt().matrixL();
    const Matrix4d D = Congruence(C, PseudoInertia(Link(step, i)));
    const Eigen::SelfAdjointEigenSolver<Matrix4d> eigen(D);
    fastest = std::max(fastest, -eigen.eigenvalues()[0]);
  }
  for (size_t t = 0; t < terms_.size(); ++t) {
    const Eigen::Index k = 10 * links_ + t;
    if (terms_[t] != TermRange::kPositive) continue;
    fastest = std::max(fastest, -step[k] / x_[k]);
  }
  return 0.9 / fastest;
}

// With C C' = P(V) and D = C^-1 P(dV) C^-T the divergence is to second order
//   |D + C' P_0^-1 C - 1|^2
// up to a constant: each Newton step is a linear least-squares problem, solved
// by QR so that R'R is never formed. Columns are scaled to length 1, as those
// of thin links are many orders longer than others. The step is halved until
// the cost falls by a tenth of what it promised (Armijo).
double Interior::Step(double weight) {
  const Eigen::Index m = R_.rows(), p = R_.cols();
  MatrixXd J = MatrixXd::Zero(m + p, p);
  VectorXd b = VectorXd::Zero(m + p);
  J.topRows(m) = R_;
  b.head(m) = z_ - R_ * x_;
  for (int i = 0; i < links_; ++i) {
    const Matrix4d C = PseudoInertia(Link(x_, i)).llt().matrixL();
    for (int k = 0; k < 10; ++k) {
      J.block<10, 1>(m + 10 * i, 10 * i + k) =
          std::sqrt(weight) *
          Vec(Congruence(C, PseudoInertia(Vector10d::Unit(k))));
    }
    const Matrix4d M = C.transpose() * P_0_[i].llt().solve(C);
    b.segment<10>(m + 10 * i) =
        std::sqrt(weight) * Vec(Matrix4d::Identity() - M);
  }
  for (size_t t = 0; t < terms_.size(); ++t) {
    const Eigen::Index k = 10 * links_ + t;
    if (terms_[t] == TermRange::kHeld) {
      J.col(k).setZero();
      J(m + k, k) = 1;
    } else if (terms_[t] == TermRange::kPositive) {
      J(m + k, k) = std::sqrt(kTermBarrier) / x_[k];
      b[m + k] = std::sqrt(kTermBarrier);
    } else {
      J(m + k, k) = 1e-6;
    }
  }
  const VectorXd s = J.colwise().norm().cwiseInverse();
  const MatrixXd scaled = J * s.asDiagonal();
  const VectorXd step = s.cwiseProduct(scaled.householderQr().solve(b));
  const double promised = step.dot(J.transpose() * b);
  const double before = Cost(x_, weight);
  double length = LongestStep(step);
  for (int k = 0; k < 30; ++k, length /= 2) {
    const VectorXd x = x_ + length * step;
    if (!(Cost(x, weight) < before - 0.1 * length * promised)) continue;
    x_ = x;
    return promised;
  }
  return 0;  // as exact as the numbers allow
}

}  // namespace

// Follows the minimum from a file that is trusted as much as all data together
// to one that is trusted as asked for, by tenths of the weight: each minimum is
// a good start for the next one, while logs without noise would send the first
// step of the last problem to the boundary.
std::optional<VectorXd> StartLinks(const MatrixXd& R, const VectorXd& z,
                                   double trust,
                                   const std::vector<TermRange>& terms,
                                   const VectorXd& x) {
  Interior interior(R, z, terms, x);
  const double last = 1 / (trust * trust);
  double weight = std::max(last, interior.DataCost());
  for (int steps = 0; steps < kMaxSteps; ++steps) {
    const double promised = interior.Step(weight);
    if (!interior.x().allFinite() || !std::isfinite(promised)) {
      return std::nullopt;
    }
    if (weight == last && promised < 1e-8) break;
    if (promised < weight) weight = std::max(last, 0.1 * weight);
  }
  VectorXd end = interior.x();
  const Eigen::Index first = x.size() - static_cast<Eigen::Index>(terms.size());
  for (size_t t = 0; t < terms.size(); ++t) {
    // What is held was stiff, not fixed: an armature of 0 is -8e-24.
    const Eigen::Index k = first + static_cast<Eigen::Index>(t);
    if (terms[t] == TermRange::kHeld) end[k] = x[k];
  }
  return end;
}

}  // namespace armcal
