#pragma once

#include <string>
#include <vector>

#include "model/log_files/log.h"

namespace armcal {

struct LogWriterOptions {
  // Torques are written as motor currents: divided by these, N m/A (N/A).
  // Empty: as torques.
  std::vector<double> torque_constants;
  // Says so in a column of that name, for what reads the log to take the torque
  // as it is (LogReaderOptions::torque_constants_stddev).
  bool simulated = false;
};

// The log as CSV (columns t, q1.., and what else it holds of qd, tau or i,
// qref, temp): microseconds, nine digits. LogReader reads it back.
std::string LogText(const Log& log, const LogWriterOptions& options = {});

}  // namespace armcal
