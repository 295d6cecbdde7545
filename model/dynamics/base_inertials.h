#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/robot/robot.h"

namespace armcal {

// The base inertial parameters of an arm (Gautier and Khalil 1990): of the
// links' ten each, columns of the regressor that all others are combinations
// of, found numerically at states drawn at random, always the same.
//   all columns = chosen columns * combinations
// so that combinations * V are the values that belong to the chosen ones.
struct BaseInertials {
  explicit BaseInertials(const Robot& robot);

  std::vector<int> columns;      // ascending
  Eigen::MatrixXd combinations;  // columns.size() x 10 n
};

}  // namespace armcal
