#pragma once

#include "calib/diagnose/judge/evidence.h"
#include "calib/diagnose/judge/found_effect.h"
#include "calib/diagnose/select/fit.h"
#include "model/robot/robot.h"

namespace armcal {

// The windows in which the arm was touched, as one effect with the estimates of
// the strongest and the largest of their probabilities. Those that are no
// contact more likely than not are among them only where none is one.
// `evidence` is that of all events of the fit, of which there is one at least.
FoundEffect FindContact(const Robot& robot, const GapFit& fit,
                        const EffectEvidence& evidence);

}  // namespace armcal
