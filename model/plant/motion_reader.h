#pragma once

#include <string>

#include "model/log_files/log.h"
#include "model/plant/reference_motion.h"
#include "model/robot/robot.h"

namespace armcal {

// A motion from a CSV in the log format: t, q1.. and, where it has them, qd1..
// and qdd1..; rates that it lacks are differences. Between rows Hermite splines
// of fifth order; before and after the rows, what the first or the last has.
// Throws InputError, also for fewer than four rows and times that do not rise.
ReferenceMotion ReadReferenceMotion(const std::string& path,
                                    const Robot& robot);

// The same through the rows of `log`, whose times begin at 0; `path` is named
// in messages.
ReferenceMotion MotionThrough(const std::string& path, const Log& log);

}  // namespace armcal
