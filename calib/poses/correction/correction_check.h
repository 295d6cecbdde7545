#pragma once

#include "calib/poses/correction/actual_arm.h"
#include "model/log_files/pose_reader.h"

namespace armcal {

// Distances of measured poses from where an arm has them, m rms, with the
// instrument's frame and the targets fitted to these poses: by the robot file,
// and by the actual arm.
struct CorrectionCheck {
  int poses = 0;
  double before = 0, after = 0;
};

// On poses that took no part in the fit. Throws OptionError where they are too
// few.
CorrectionCheck CheckCorrection(const ActualArm& arm,
                                const PoseMeasurements& held_out);

}  // namespace armcal
