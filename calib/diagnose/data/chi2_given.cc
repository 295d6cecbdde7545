#include "calib/diagnose/data/chi2_given.h"

#include "calib/diagnose/data/inner_products.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// With whitened rows y, a torque T, the normal equations' matrix N and their
// right-hand side b(T) = b(0) - A'T, the least squares are
//   chi^2(T) = |y - T|^2 - b(T)' N^-1 b(T) + const,
// of which products of all torques with the columns A are one product of
// matrices, and no residual is formed. The constant is chi^2(0)'s.
VectorXd Chi2Given(const BaselineFit& fit,
                   const std::vector<JointRows>& torques) {
  const auto count = static_cast<Eigen::Index>(torques.size());
  const VectorXd x = fit.factor().Solve(fit.gradient());
  VectorXd chi2 = VectorXd::Constant(
      count, fit.ResidualGiven(JointRows(fit.num_joints())).squaredNorm() +
                 fit.gradient().dot(x));
  MatrixXd gradient = fit.gradient().replicate(1, count);
  for (int j = 0; j < fit.num_joints(); ++j) {
    const BaselineFit::Rows& rows = fit.rows(j);
    MatrixXd torque = MatrixXd::Zero(rows.target.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
      if (torques[k][j].size() > 0) torque.col(k) = torques[k][j];
    }
    chi2 += torque.colwise().squaredNorm().transpose() -
            2 * fit.weight(j) * torque.transpose() * rows.target;
    gradient(rows.columns.which, Eigen::all) -=
        fit.ScaleOf(j).asDiagonal() *
        InnerProducts(rows.columns.values, torque);
  }
  return chi2 - gradient.cwiseProduct(fit.factor().Solve(gradient))
                    .colwise()
                    .sum()
                    .transpose();
}

}  // namespace armcal
