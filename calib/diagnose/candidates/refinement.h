#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
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
                             GapData* data);

// What effects with these parameters add to the torque: per joint thinned
// samples, empty where it is nothing. What happened once is not in other logs
// than those it was found in.
JointRows EffectTorque(const GapBaseline& baseline, const MotionScale& scale,
                       const std::vector<GapCandidate>& effects, GapData* data);
// The same of several such sets, by a thread's own `torques`, one per segment.
std::vector<JointRows> EffectTorques(
    const GapBaseline& baseline, const MotionScale& scale,
    const std::vector<std::vector<GapCandidate>>& sets, const GapRows& rows,
    std::vector<RecordedTorque>* torques);
// Their rows.
JointRows WhitenEach(const GapRows& rows, const JointRows& thin);

}  // namespace armcal
