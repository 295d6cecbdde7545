#include "calib/drive_gains/solution.h"

#include <ceres/manifold.h>
#include <ceres/problem.h>

#include <algorithm>
#include <cmath>

#include "calib/numerics/singular_values.h"
#include "model/signals/dense_solvers.h"
#include "problems/dense_solver.h"

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kSeenRelative = 1e-8;  // relative to the direction seen best

// The factor's triangle of joint i, its columns those of all parameters.
CurrentEquations Expand(const BlockTriangularFactor& factor, int i,
                        bool loaded) {
  const MatrixXd& R = factor.Triangle(i);
  const std::vector<int>& columns = factor.columns(i);
  CurrentEquations e{i, loaded,
                     MatrixXd::Zero(R.rows(), factor.num_parameters()),
                     R.rightCols<1>()};
  for (size_t c = 0; c < columns.size(); ++c) e.A.col(columns[c]) = R.col(c);
  return e;
}

bool HasCurrent(const CurrentFactors& factors, int i) {
  const auto norm = [i](const BlockTriangularFactor& factor) {
    return factor.Triangle(i).rightCols<1>().norm();
  };
  return norm(factors.bare) > 0 &&
         (factors.loaded.rows(i) == 0 || norm(factors.loaded) > 0);
}

}  // namespace

VectorXd UntiedNoise(const CurrentFactors& factors) {
  const int n = factors.bare.num_joints();
  VectorXd noise = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    double squares = 0, current = 0, free = 0;
    for (const auto* factor : {&factors.bare, &factors.loaded}) {
      if (factor->rows(i) == 0) continue;
      const VectorXd z = factor->Triangle(i).rightCols<1>();
      squares += std::pow(z[z.size() - 1], 2);
      current += z.squaredNorm();
      free += std::max(0.0, 1.0 * factor->rows(i) - (z.size() - 1));
    }
    if (!HasCurrent(factors, i) || free < 1) continue;
    noise[i] = std::max(
        std::sqrt(squares / free),
        1e-9 * std::sqrt(current / static_cast<double>(factors.rows(i))));
  }
  return noise;
}

VectorXd GainNoise(const CurrentFactors& factors, const MatrixXd& B,
                   const GainEstimate& estimate, const VectorXd& noise) {
  const int n = factors.bare.num_joints();
  double rows = 0;
  for (int i = 0; i < n; ++i) {
    if (noise[i] > 0) rows += static_cast<double>(factors.rows(i));
  }
  const double spent = static_cast<double>(estimate.x.size());
  const double correction = rows > spent ? rows / (rows - spent) : 1;
  VectorXd squares = VectorXd::Zero(n);
  for (const CurrentEquations& e : WhitenedEquations(factors, noise)) {
    const VectorXd x =
        e.loaded ? VectorXd(estimate.x + B * estimate.p) : estimate.x;
    squares[e.joint] += (estimate.g[e.joint] * e.A * x - e.z).squaredNorm();
  }
  VectorXd result = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    if (noise[i] <= 0) continue;
    const double mean = squares[i] / static_cast<double>(factors.rows(i));
    // Rounding may leave less than noise without a limit would.
    result[i] = noise[i] * std::max(std::sqrt(correction * mean), 1e-3);
  }
  return result;
}

std::vector<CurrentEquations> WhitenedEquations(const CurrentFactors& factors,
                                                const VectorXd& noise) {
  std::vector<CurrentEquations> equations;
  for (int i = 0; i < noise.size(); ++i) {
    if (noise[i] <= 0) continue;
    for (const bool loaded : {false, true}) {
      const auto& factor = loaded ? factors.loaded : factors.bare;
      if (factor.rows(i) == 0) continue;
      equations.push_back(Expand(factor, i, loaded));
      equations.back().A /= noise[i];
      equations.back().z /= noise[i];
    }
  }
  return equations;
}

bool RefineGains(const std::vector<CurrentEquations>& equations,
                 const MatrixXd& B, int reference, GainEstimate* estimate) {
  const int n = static_cast<int>(estimate->g.size());
  double* const g = estimate->g.data();
  ceres::Problem problem;
  problem.AddResidualBlock(new DriveGainResidual(equations, n, B), nullptr, g,
                           estimate->x.data(), estimate->p.data());
  if (n > 1) {
    problem.SetManifold(g, new ceres::SubsetManifold(n, {reference}));
  } else {
    problem.SetParameterBlockConstant(g);
  }
  const ceres::Solver::Summary summary = SolveDense(1e-12, &problem);
  return summary.IsSolutionUsable() && estimate->g.allFinite() &&
         estimate->x.allFinite() && estimate->p.allFinite();
}

GainSensitivity::GainSensitivity(const std::vector<CurrentEquations>& equations,
                                 const MatrixXd& B,
                                 const GainEstimate& estimate, int reference) {
  const Index n = estimate.g.size(), m = estimate.x.size();
  const DriveGainResidual residual(equations, static_cast<int>(n), B);
  const Index rows = residual.num_residuals();
  VectorXd r(rows);
  RowMajor by_g(rows, n), by_x(rows, m), by_p(rows, 10);
  const double* const parameters[] = {estimate.g.data(), estimate.x.data(),
                                      estimate.p.data()};
  double* jacobians[] = {by_g.data(), by_x.data(), by_p.data()};
  residual.Evaluate(parameters, r.data(), jacobians);
  J_.resize(rows, n + m + 10);
  J_ << by_g, by_x, by_p;
  J_.col(reference).setZero();
  Decompose();
}

GainSensitivity::GainSensitivity(const GainSensitivity& other,
                                 const std::vector<int>& known)
    : J_(other.J_) {
  for (const int k : known) J_.col(k).setZero();
  Decompose();
}

void GainSensitivity::Decompose() {
  inverse_norms_ = J_.colwise().norm();
  for (double& x : inverse_norms_) x = x > 0 ? 1 / x : 1;
  const SingularValues svd =
      DecomposeSingular(J_ * inverse_norms_.asDiagonal());
  s_ = svd.s;
  V_ = svd.V.leftCols(s_.size());
  rank_ = static_cast<int>((s_.array() > kSeenRelative * s_[0]).count());
}

bool GainSensitivity::Sees(const VectorXd& d) const {
  const VectorXd y = inverse_norms_.cwiseProduct(d);
  const VectorXd seen = V_.leftCols(rank_).transpose() * y;
  const double unseen = y.squaredNorm() - seen.squaredNorm();
  return unseen < 1e-6 * y.squaredNorm();
}

MatrixXd GainSensitivity::Gain() const {
  const MatrixXd half = inverse_norms_.asDiagonal() * V_.leftCols(rank_) *
                        s_.head(rank_).cwiseInverse().asDiagonal();
  return half * half.transpose();
}

}  // namespace armcal
