#pragma once

#include <Eigen/Core>

#include "calib/poses/diagnosis/model.h"

namespace armcal {

// Where two models of the same poses would differ most.
struct PoseSeparation {
  Eigen::VectorXd q;  // joint positions within the range of the poses
  double differ = 0;  // m, of a target
};
PoseSeparation SeparatingPose(const PoseStudy& study, const PoseModel& a,
                              const PoseModel& b);

}  // namespace armcal
