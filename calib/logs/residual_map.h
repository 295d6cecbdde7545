#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/numerics/binned_profile.h"

namespace armcal {

// Where the residuals of one joint lie, a signal per model: over what the joint
// does at that moment.
struct ResidualMap {
  explicit ResidualMap(int num_models);

  struct At {
    double position, velocity;  // rad or m, rad/s or m/s
    double load;                // predicted torque, N m or N
    double time;                // s
  };
  void Add(const At& at, const Eigen::VectorXd& residuals);

  BinnedProfile position, velocity, load, time;
};

}  // namespace armcal
