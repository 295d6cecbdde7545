#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/baseline.h"

namespace armcal {

// Columns of friction that differs from day to day.
std::vector<int> DayColumns(const GapBaseline& baseline);

// Whether x (with its covariance) says that logs are of another day than their
// reference: friction differs on three joints, on all of smaller arms.
bool IsAnotherDay(const GapBaseline& baseline, const Eigen::VectorXd& x,
                  const Eigen::MatrixXd& covariance);

}  // namespace armcal
