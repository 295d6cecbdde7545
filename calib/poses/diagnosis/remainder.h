#pragma once

#include "calib/poses/diagnosis/finding.h"

namespace armcal {

// What the effects leave, beside the instrument and over the order of poses,
// and the verdict, which follows from it and from what was found.
void JudgeRemainder(const PoseStudy& study, PoseDiagnosis* diagnosis);

}  // namespace armcal
