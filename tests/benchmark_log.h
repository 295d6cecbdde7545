#pragma once

#include "model/log.h"
#include "model/robot.h"

namespace armcal {

// The arm of all benchmarks: the UR10e of the shared data, or where these are
// absent the six-axis arm of data/. Both are 6R of general geometry; what the
// kernels do does not depend on their numbers.
Robot BenchmarkRobot();

// Its motion at 1 kHz, three sines per joint, with q, qd, qdd and the torque of
// recursive Newton-Euler. The same for the same arguments.
Log BenchmarkLog(const Robot& robot, long samples);

}  // namespace armcal
