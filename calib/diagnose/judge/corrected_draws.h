#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/judge/corrected_posterior.h"

namespace armcal {

// Robots that a diagnosis allows for, each as likely as the other, with the
// effects that it found.
struct CorrectedDraws {
  std::vector<CorrectedRobot> robots;
  std::string refusal;  // why there are none
};

// Draws from the posterior as far as such robots can exist: every link that the
// model may change is a body, friction at any speed, armature and masses are
// not negative, effects are within the bounds that they were fitted in and, of
// those that say so, of a real arm. `file`: the robot without corrections,
// whose links stand where no others near the fitted ones can exist. `count`
// robots, the same for the same fit.
CorrectedDraws DrawCorrected(const GapFit& fit,
                             const CorrectedPosterior& posterior,
                             const Robot& file, int count);

}  // namespace armcal
