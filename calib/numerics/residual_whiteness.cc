#include "calib/numerics/residual_whiteness.h"

#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::ArrayXd;

ResidualWhiteness::ResidualWhiteness(int num_joints)
    : sums_(ArrayXd::Zero(num_joints)), white_(sums_), blocks_(sums_) {}

void ResidualWhiteness::Add(const Eigen::MatrixXd& residuals, int block) {
  for (Eigen::Index begin = 0; begin + block <= residuals.rows();
       begin += block) {
    const auto part = residuals.middleRows(begin, block);
    const ArrayXd squares = part.colwise().squaredNorm().transpose();
    sums_ += part.colwise().sum().transpose().array().square();
    white_ += squares;
    blocks_ += (squares > 0).cast<double>();
  }
}

double ResidualWhiteness::ratio() const {
  return white_.sum() > 0 ? sums_.sum() / white_.sum() : 1;
}

double ResidualWhiteness::worst_ratio() const {
  return (white_ > 0).select(sums_ / white_, 1).maxCoeff();
}

bool ResidualWhiteness::IsWhite() const {
  const auto is_large = [](double ratio, double blocks) {
    return ratio > 1 + 4 * std::sqrt(2 / std::max(1.0, blocks));
  };
  for (Eigen::Index j = 0; j < sums_.size(); ++j) {
    if (white_[j] > 0 && is_large(sums_[j] / white_[j], blocks_[j])) {
      return false;
    }
  }
  return !is_large(ratio(), blocks_.sum());
}

}  // namespace armcal
