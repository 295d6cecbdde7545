#pragma once

#include <Eigen/Core>

namespace armcal {

// a' b, whole groups of rows in lanes.
Eigen::MatrixXd InnerProducts(const Eigen::MatrixXd& a,
                              const Eigen::MatrixXd& b);

}  // namespace armcal
