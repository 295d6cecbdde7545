#pragma once

#include <vector>

#include "calib/inspect/frozen_channels.h"
#include "calib/logs/inspection_finding.h"
#include "model/log_files/log.h"
#include "model/log_files/row_range.h"
#include "model/robot/robot.h"

namespace armcal {

// Whether a finding is of that column: its sentence begins with the signal.
bool IsOf(const FrozenChannel& run, const InspectionFinding& finding);

// What to say of them; they lead.
std::vector<InspectionFinding> FrozenFindings(
    const Robot& robot, const Eigen::VectorXd& t,
    const std::vector<FrozenChannel>& frozen);

std::vector<RowRange> RowsOf(const std::vector<FrozenChannel>& frozen);
// The log without these rows: a hole of its stamps, as motion or torque is not
// known there.
Log WithoutFrozenRows(const Log& log, const std::vector<FrozenChannel>& frozen);

// The velocity goes on where a position stood still: takes findings that it is
// not the position's slope from those of joints whose position did, unless
// `others`, what is said of the log without these rows, has them, too.
void DropVelocitiesOfFrozen(const std::vector<FrozenChannel>& frozen,
                            const std::vector<InspectionFinding>& others,
                            std::vector<InspectionFinding>* findings);

}  // namespace armcal
