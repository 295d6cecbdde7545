#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/candidates/effect_torques.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/screen.h"

namespace armcal {

// Effects with all their parameters fitted together, linear or not, the
// baseline free given them.
struct RefinedEffects {
  std::vector<GapCandidate> effects;  // p: all parameters
  // Of all parameters one after the other, in SI units; a parameter at its
  // bound has no variance.
  Eigen::MatrixXd covariance;
  Eigen::VectorXd baseline;
  double delta_chi2 = 0;  // against the baseline alone
};

// Variable projection by Ceres from the effects' p, of effect `only` or (-1) of
// all of them. Each one's torque is evaluated as it is, not linearised; what
// one changes in the torque of another is left out.
RefinedEffects RefineEffects(const GapScreen& screen,
                             const GapBaseline& baseline,
                             const MotionScale& scale,
                             const std::vector<GapCandidate>& effects, int only,
                             GapData* data,
                             const std::vector<JointRows>* around = nullptr);
// What RefineEffects looks at before it starts, `around`, for fits of the same
// effects to parts of the same logs: a torque does not depend on which rows
// count, nor on how much.
std::vector<JointRows> TorquesAround(const GapBaseline& baseline,
                                     const MotionScale& scale,
                                     const std::vector<GapCandidate>& effects,
                                     int only, const GapData& data);

}  // namespace armcal
