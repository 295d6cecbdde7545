#pragma once

#include <string>

#include "calib/diagnose/diagnosis.h"
#include "model/effects/effect.h"

namespace armcal {

// An effect and where it is in words: "payload", "stribeck on elbow".
std::string NameOf(const Effect& effect, int joint,
                   const GapDiagnosis& diagnosis);

// What changes are told since: "the reference" or "the calibration"; empty: the
// robot file, since which nothing is said to have changed.
std::string SinceWhat(const GapDiagnosis& diagnosis);

// Whether an effect of this probability is told without a "probably".
bool IsConfident(double probability);

// The sentence a colleague would want to read.
std::string BriefReport(const GapDiagnosis& diagnosis);

}  // namespace armcal
