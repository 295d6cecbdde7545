#include "calib/numerics/noise_sums.h"

namespace armcal {

NoiseSums::NoiseSums(int num_joints)
    : count(Eigen::ArrayXd::Zero(num_joints)),
      fitted(count),
      squares(count),
      slope(count),
      outliers(count) {}

}  // namespace armcal
