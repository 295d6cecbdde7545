#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/logs/inspection_finding.h"
#include "calib/logs/position_jumps.h"
#include "model/robot/robot.h"

namespace armcal {

// What to say of positions that jump; t: of the log's rows, s. Where the clock
// is wrong, time that is missing is known.
std::vector<InspectionFinding> JumpFindings(const Robot& robot,
                                            const Eigen::VectorXd& t,
                                            const LogJumps& jumps,
                                            bool clock_is_wrong);

}  // namespace armcal
