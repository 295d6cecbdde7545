#include "calib/diagnose/judge/predicted_chi2.h"

#include <utility>

#include "calib/diagnose/data/inner_products.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The residual of held-out data has the variance I + X N^-1 X', what the noise
// and the uncertain values of the model make of it (Gelman et al. 2013, 14.2).
// By Woodbury's identity its inverse is
//   (I + X N^-1 X')^-1 = I - X (N + X'X)^-1 X',
// N + X'X being the information once these rows are known too, so that neither
// rows x rows matrices nor N's inverse are formed.
PredictedChi2::PredictedChi2(std::vector<BaselineColumns> columns,
                             MatrixXd information)
    : columns_(std::move(columns)) {
  for (const BaselineColumns& own : columns_) {
    information(own.which, own.which) += InnerProducts(own.values, own.values);
  }
  both_.compute(information);
}

// |r|^2 - |L^-1 X' r|^2, N + X'X = L L'.
double PredictedChi2::Of(const JointRows& residual) const {
  double squares = 0;
  VectorXd s = VectorXd::Zero(both_.rows());
  for (size_t j = 0; j < residual.size(); ++j) {
    if (residual[j].size() == 0) continue;
    squares += residual[j].squaredNorm();
    s(columns_[j].which) += columns_[j].values.transpose() * residual[j];
  }
  return squares - VectorXd(both_.matrixL().solve(s)).squaredNorm();
}

}  // namespace armcal
