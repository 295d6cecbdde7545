#include "calib/poses/variance_components.h"

#include <Eigen/QR>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

// |Z_j' M Z_k|^2 of M = I - Q Q', without M, which is as large as the square of
// all residuals.
double Shared(const VarianceComponent& j, const VarianceComponent& k) {
  const Sparse product = j.Z.transpose() * k.Z;
  double cross = 0;
  for (int c = 0; c < product.outerSize(); ++c) {
    for (Sparse::InnerIterator at(product, c); at; ++at) {
      cross += at.value() * j.G.row(at.row()).dot(k.G.row(at.col()));
    }
  }
  return product.squaredNorm() - 2 * cross + j.S.cwiseProduct(k.S).sum();
}

}  // namespace

VarianceComponent::VarianceComponent(
    const std::vector<Eigen::Triplet<double>>& entries, Eigen::Index columns,
    const MatrixXd& Q)
    : Z(Q.rows(), columns) {
  Z.setFromTriplets(entries.begin(), entries.end());
  Z *= std::sqrt(static_cast<double>(Q.rows()) / Z.squaredNorm());
  G = Z.transpose() * Q;
  S = G.transpose() * G;
}

// By E |Z_j' psi|^2 = sum_k variance_k |Z_j' M Z_k|^2, which is unbiased
// whatever the estimate has taken out of the errors (MINQUE; Rao 1971, J.
// Multivariate Analysis 1; Searle, Casella and McCulloch 1992, ch. 11). What
// the fit has taken whole leaves no equation, but what rounding leaves of
// |Z' Z|^2, and has no variance.
VectorXd VariancesOf(const std::vector<VarianceComponent>& components,
                     const VectorXd& psi) {
  constexpr double kRounded = 1e-9;  // what rounding may leave of a square
  const auto size = static_cast<Eigen::Index>(components.size());
  MatrixXd shared(size, size);
  VectorXd moments(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    moments[j] = (components[j].Z.transpose() * psi).squaredNorm();
    for (Eigen::Index k = 0; k < size; ++k) {
      shared(j, k) = Shared(components[j], components[k]);
    }
  }
  std::vector<Eigen::Index> there;
  for (Eigen::Index k = 0; k < size; ++k) {
    const double whole =
        (components[k].Z.transpose() * components[k].Z).eval().squaredNorm();
    if (shared(k, k) > kRounded * whole) there.push_back(k);
  }
  VectorXd variances = VectorXd::Zero(size);
  while (!there.empty()) {
    const VectorXd solved =
        shared(there, there).colPivHouseholderQr().solve(moments(there));
    Eigen::Index least = 0;
    if (!(solved.minCoeff(&least) < 0)) {
      for (size_t k = 0; k < there.size(); ++k) {
        variances[there[k]] = solved[static_cast<Eigen::Index>(k)];
      }
      break;
    }
    there.erase(there.begin() + least);
  }
  return variances;
}

}  // namespace armcal
