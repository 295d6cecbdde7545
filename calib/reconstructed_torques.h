#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/data/audit.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"
#include "model/robot/robot.h"

namespace armcal {

// Reconstructs the torques of logs that have commands in their place, by the
// law of the drives in the file `controller` (docs/simulate.md). Positions are
// to be mended before (MendPositions): at rows that are left out the drives are
// taken to have seen the motion go on from the rows before to those after.
// Throws InputError. Tells where a joint's torque stands at its limit for as
// many samples as a recorded one that is cut off (AuditChannels): the limit may
// be the robot file's, which nobody gave for this loop.
std::vector<DataFinding> ReconstructTorques(const Robot& robot,
                                            const std::string& controller,
                                            const std::vector<LogSource>& logs,
                                            LogReaderOptions* reading);

}  // namespace armcal
