#pragma once

#include "calib/logs/log_set.h"
#include "calib/logs/sample_pass.h"

namespace armcal {

// Gross errors of single torque samples, found by what the parameters of a
// calibration predict at them: samples whose residual sticks out of the
// residuals around it (FindOutlying, 15 samples on either side) by more than 8
// noise deviations and a hundredth of the torque, where the torque itself jumps
// by half as much. They are replaced by the prediction: once calibration and
// replacement agree, such samples count for nothing, like missing data. One
// list per log, in the order of rows. One pass over the logs at full rate.
OutlierLists FindTorqueOutliers(SamplePass* pass);

// Whether the lists of as many logs name the same samples.
bool SameSamples(const OutlierLists& a, const OutlierLists& b);

}  // namespace armcal
