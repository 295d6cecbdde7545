#pragma once

#include <Eigen/Core>
#include <string>

#include "calib/poses/fit.h"
#include "calib/refine/arm_unknowns.h"
#include "calib/refine/link_equations.h"
#include "calib/refine/pose_information.h"

namespace armcal {

// The fit of an arm's unknowns to torque equations and measured poses at once,
// with the robot file as prior: links in log-Cholesky coordinates, hence
// physically consistent; friction and armature not negative.
class ArmFit {
 public:
  // `poses`: null without measured poses. All are kept by reference.
  ArmFit(const ArmUnknowns& unknowns, const ArmTrust& trust,
         const PoseFit* poses);

  // Links and joint terms from any start, for the geometry of `values`
  // (StartLinks). False where numbers overflow.
  bool Start(const LinkEquations& torques, ArmValues* values) const;

  struct End {
    bool usable = false;
    std::string reason;  // Ceres' word
    int iterations = 0;
  };
  End Solve(const LinkEquations& torques, ArmValues* values) const;

  // The prior's information, near the file's values.
  Eigen::MatrixXd PriorInformation(const ArmTrust& trust) const;
  PoseInformation InformByPoses(const ArmValues& values) const {
    return armcal::InformByPoses(unknowns_, poses_, values);
  }

 private:
  const ArmUnknowns& unknowns_;
  const ArmTrust& trust_;
  const PoseFit* poses_;
};

}  // namespace armcal
