#pragma once

#include <string>
#include <vector>

#include "calib/linear/used_equations.h"
#include "calib/logs/inspection_finding.h"
#include "model/log_files/log_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// What a log that is read rightly can tell of the arm.
struct LogCoverage {
  bool known = false;  // false: `reason` says why nothing is told
  std::string reason;
  int rank = 0, total = 0;  // directions of the model parameters that show
  std::vector<std::string> unseen;  // the others
  std::string advice;               // what to move to see them
  // What calibrating on it leaves, %, and its gross errors per joint.
  double residual_percent = 0;
  std::vector<long> outliers;
  // Joints whose torque is next to nothing beside what gravity and inertia of
  // the file's links need.
  std::vector<UnpoweredJoint> unpowered;
  std::string noise_source;  // repeats, standstill or what the model leaves
  std::string time_base;     // samples, steps and gaps in a sentence
  double stamp_wander = 0;   // s, of stamps beside even samples
  // What a diagnosis would lack, a sentence; empty: nothing, by its length.
  std::string too_short;
  // What would spoil a calibration or a diagnosis: torques computed from
  // positions, more gross errors in motion than now and then.
  std::vector<InspectionFinding> findings;
};

// Calibrates the model parameters on the log. Bad input is a reason.
LogCoverage CoverageOf(const Robot& robot, const LogSource& log,
                       const LogReaderOptions& options);

}  // namespace armcal
