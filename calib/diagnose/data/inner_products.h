#pragma once

#include <Eigen/Core>

namespace armcal {

// a' b, whole groups of rows in lanes.
Eigen::MatrixXd InnerProducts(const Eigen::Ref<const Eigen::MatrixXd>& a,
                              const Eigen::Ref<const Eigen::MatrixXd>& b);

// The same of all columns of a with its last `count`. What these have with each
// other is worked out once, not from either side.
Eigen::MatrixXd InnerProductsWithLast(
    const Eigen::Ref<const Eigen::MatrixXd>& a, Eigen::Index count);

}  // namespace armcal
