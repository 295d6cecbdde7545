#include "calib/poses/frame_values.h"

#include <cmath>

namespace armcal {

Eigen::Matrix<double, 6, 1> FrameValues(const Eigen::Matrix3d& R,
                                        const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 6, 1> values;
  values << p, std::atan2(R(1, 0), R(0, 0)),
      std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
      std::atan2(R(2, 1), R(2, 2));
  return values;
}

}  // namespace armcal
