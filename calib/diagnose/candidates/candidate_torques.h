#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"

namespace armcal {

// Low-passes and thins torques of a segment into the thinned samples of all,
// per joint; joints that they are nothing of stay empty.
void AddThinned(const GapRows& rows, int segment,
                const std::vector<RecordedTorque::OfJoints>& torques,
                const std::vector<JointRows*>& thin);

// Of candidates that were evaluated for the first robot, those whose torques
// are the same for the second, the robots' joint terms (friction, offset,
// armature) differing alone: an effect at one joint adds to the torque what it
// adds whatever another joint's friction is, unless it is one of the drive or
// the sensor, which may mix the torques of several.
std::vector<GapCandidate> WithSameTorques(const Robot& first,
                                          const Robot& second,
                                          const MotionScale& scale,
                                          std::vector<GapCandidate> evaluated);

// Moves torques to candidates from those that are the same, which are left
// without.
void ReuseTorques(std::vector<GapCandidate>* evaluated,
                  std::vector<GapCandidate>* candidates);

// Fills in the torques of those that have none, several at a time.
void EvaluateCandidates(const GapBaseline& baseline, const GapRows& rows,
                        const MotionScale& scale,
                        const std::vector<RecordedTorque>& torques,
                        std::vector<GapCandidate>* candidates);

}  // namespace armcal
