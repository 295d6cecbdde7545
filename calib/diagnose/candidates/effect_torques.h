#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/data.h"

namespace armcal {

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
