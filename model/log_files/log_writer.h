#pragma once

#include <string>
#include <vector>

#include "model/log_files/log.h"

namespace armcal {

struct LogWriterOptions {
  // Torques are written as motor currents: divided by these, N m/A (N/A).
  // Empty: as torques.
  std::vector<double> torque_constants;
};

// The log as CSV (columns t, q1.., and what else it holds of qd, tau or i,
// qref, temp, fx.. and whether it is simulated): microseconds, nine digits.
// LogReader reads it back.
std::string LogText(const Log& log, const LogWriterOptions& options = {});

}  // namespace armcal
