#pragma once

#include <vector>

#include "calib/inspect/frozen_channels.h"
#include "calib/logs/position_jumps.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

// Positions that stand still for a while and then go on in one step by what the
// joint has moved meanwhile, as of an encoder that is not answered: no arm is
// needed to tell these. The step is one that is none of its motion (FindJumps,
// which takes the time since the position last changed for the step's own), and
// the rows of one number are more than chance has beside the joint's other
// steps (TooLongForChance), so that values which a slow controller holds all
// the time are none. Where another joint jumps in the same row, time is missing
// there or two logs meet. Where the joint rests, the step may be of its zero
// (AddZerosLostAtRest). The log has its time in s, and no wraps (MendJumps).
std::vector<FrozenChannel> FindStuckPositions(const Robot& robot,
                                              const Log& log);

// Adds to the jumps the steps of one joint that rests before or after them and
// would not have come that far: its zero is another one from then on.
// FindPositionJumps has those in motion: it takes the whole rest for a step's
// time, in which the joint may have gone there.
void AddZerosLostAtRest(const Robot& robot, const Log& log, LogJumps* jumps);

// These, and what the arm's torques tell of (FindFrozenChannels, of the log
// without them and without rows of other zeros), in rows of the log.
// `mean_step`: of its stamps (AuditStamps), s.
std::vector<FrozenChannel> FindAllFrozenChannels(const Robot& robot,
                                                 const Log& log,
                                                 const LogJumps& jumps,
                                                 double mean_step);

}  // namespace armcal
