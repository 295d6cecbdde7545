#include "calib/diagnose/judge/predicted_chi2.h"

#include <Eigen/Cholesky>
#include <utility>

#include "calib/diagnose/data/inner_products.h"
#include "calib/numerics/posterior.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The residual of held-out data has the variance I + X C X', what the noise and
// the uncertain values of the model make of it (Gelman et al. 2013, 14.2). With
// C = L L' and B = I + L' X' X L its inverse is, by Woodbury's identity,
//   (I + X C X')^-1 = I - X L B^-1 L' X',
// so that half = B's Cholesky factor^-1 L' serves every residual, and rows x
// rows matrices are never formed.
PredictedChi2::PredictedChi2(std::vector<BaselineColumns> columns,
                             const MatrixXd& covariance)
    : columns_(std::move(columns)) {
  MatrixXd information =
      MatrixXd::Zero(covariance.rows(), covariance.cols());  // X'X
  for (const BaselineColumns& own : columns_) {
    information(own.which, own.which) += InnerProducts(own.values, own.values);
  }
  const MatrixXd root = SquareRoot(covariance);  // L'
  MatrixXd B = root * information * root.transpose();
  B.diagonal().array() += 1;
  half_ = B.llt().matrixL().solve(root);
}

// r' (I + X C X')^-1 r = |r|^2 - |half X' r|^2.
double PredictedChi2::Of(const JointRows& residual) const {
  double squares = 0;
  VectorXd s = VectorXd::Zero(half_.cols());
  for (size_t j = 0; j < residual.size(); ++j) {
    if (residual[j].size() == 0) continue;
    squares += residual[j].squaredNorm();
    s(columns_[j].which) += columns_[j].values.transpose() * residual[j];
  }
  return squares - (half_ * s).squaredNorm();
}

}  // namespace armcal
