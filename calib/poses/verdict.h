#pragma once

#include <string>
#include <vector>

#include "calib/poses/calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// Sentences that say why a fit of poses does not give what was asked for: it
// has no solution, a joint never moves, the poses do not follow the joints, or
// most of them are outliers. None where all is well.
std::vector<std::string> Shortcomings(const Robot& robot,
                                      const PoseCalibration& result);

}  // namespace armcal
