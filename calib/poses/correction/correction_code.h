#pragma once

#include <string>

#include "calib/poses/correction/actual_arm.h"
#include "calib/poses/correction/correction_table.h"

namespace armcal {

// C source, of any C99 compiler and without other files than the C library,
// that computes both joint corrections at any posture: `arm` in numbers, and
// the formulas of actual_arm.cc and joint_correction.cc. `errors` are told in
// its comment.
std::string CorrectionCode(const ActualArm& arm,
                           const CorrectionErrors& errors);

}  // namespace armcal
