#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

namespace armcal {

// A cause of errors e = Z a, with as many independent amounts a as columns, all
// of one variance: what is added up of several makes a mixed model (Searle,
// Casella and McCulloch 1992). Z is scaled to a mean square of 1 a row, as the
// identity has it, so that a variance is the mean square that it makes of a
// residual.
struct VarianceComponent {
  // `Q`: an orthonormal basis of what an estimate takes out of the errors.
  VarianceComponent(const std::vector<Eigen::Triplet<double>>& entries,
                    Eigen::Index columns, const Eigen::MatrixXd& Q);
  Eigen::SparseMatrix<double> Z;
  Eigen::MatrixXd G;  // Z'Q
  Eigen::MatrixXd S;  // G'G, the covariance of Q'e of a variance of 1
};

// Their variances, of what M = I - Q Q' leaves of the errors, psi = M e. One
// below 0 is none, and the others are solved for again.
Eigen::VectorXd VariancesOf(const std::vector<VarianceComponent>& components,
                            const Eigen::VectorXd& psi);

}  // namespace armcal
