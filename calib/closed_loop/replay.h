#pragma once

#include <Eigen/Core>
#include <string>

#include "model/dynamics/joint_controller.h"
#include "model/dynamics/simulated_robot.h"
#include "model/log_files/log.h"
#include "model/log_files/log_reader.h"
#include "model/log_files/time_base.h"
#include "model/plant/reference_motion.h"
#include "model/robot/robot.h"

namespace armcal {

// A log whose command qref can be followed, in memory as a whole.
struct CommandedLog {
  std::string path;
  Log log;  // times from 0: positions, qref and, where it has it, torque
  double begin = 0;  // of them, s since the log's first row
  // The command (t and qref) also in rows whose positions are left out, which
  // the drives followed all the same; empty: there are none.
  Log command{};
};

// The rows of a log within `crop` that are not left out
// (LogReaderOptions::left_out). Throws InputError where it has no qref columns,
// more than 2^20 rows or nothing is left.
CommandedLog ReadCommandedLog(const LogSource& source,
                              const LogReaderOptions& options,
                              const TimeRange& crop);
// The same of a log that has been read, with the rows to leave out.
CommandedLog CommandedRows(const std::string& path, const Log& all,
                           const TimeRange& crop,
                           const LogReaderOptions& options);

// The command as a motion: before and after the rows as at their ends.
ReferenceMotion CommandedMotion(const CommandedLog& commanded);

// The row from which on replays count: a log that does not begin at rest is
// caught up with in its first second.
int FirstCounted(const Log& log);

// What a simulated robot did instead of the real one.
struct ClosedLoopReplay {
  bool finite = true;  // the simulated loop is stable; else nothing follows
  // Simulated minus recorded from FirstCounted() on, samples x n, rad or m, N m
  // or N.
  Eigen::MatrixXd position;
  Eigen::MatrixXd torque;  // empty where the log has none
};

// Lets `plant`, moved by our own dynamics, follow the command of the log under
// a controller that knows the robot `known`. `delay`: by how much recorded
// torque is later than the motion, s. A positive one is the recording's, and
// the motion does not feel it; a negative one that of the drives, as a
// first-order lag.
ClosedLoopReplay ReplayClosedLoop(const SimulatedRobot& plant, double delay,
                                  const Robot& known,
                                  const ControllerOptions& controller,
                                  const CommandedLog& commanded);

}  // namespace armcal
