#pragma once

#include "calib/diagnose/candidates/corrected_robot.h"
#include "calib/diagnose/data/data.h"

namespace armcal {

// Sets the effects' `share`: how much of each of their joint's stand_ins files
// without their law have in their stead. It is the least-squares fit of those
// terms to what the effect adds to the torque along the logs, in the rows that
// the effects themselves were fitted to: what a robot that is fitted without
// the effect would have taken it for.
void SetLawShares(const GapBaseline& baseline, GapData* data,
                  CorrectedRobot* corrected);

// Of the effect in this term, SI units; 0 of what does not stand for it.
double ShareOf(const CarriedEffect& effect, JointTerm term);
bool HasShare(const CarriedEffect& effect);

}  // namespace armcal
