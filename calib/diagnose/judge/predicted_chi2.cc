#include "calib/diagnose/judge/predicted_chi2.h"

#include <Eigen/Cholesky>
#include <utility>

#include "calib/diagnose/data/inner_products.h"
#include "calib/numerics/posterior.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
