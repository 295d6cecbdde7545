#pragma once

#include <string>
#include <vector>

#include "calib/linear_calibration.h"
#include "tests/sample_motion.h"
#include "tests/temp_file.h"

namespace armcal {

// CalibrateLinear as a user meets it, on logs written to files; with_rates:
// velocities and accelerations are in the files too.
inline LinearCalibration CalibrateLogs(const Robot& robot,
                                       const std::vector<Log>& logs,
                                       const LinearCalibrationOptions& options,
                                       bool with_rates = false) {
  std::vector<std::string> paths;
  for (const Log& log : logs) {
    paths.push_back(WriteFile(LogCsv(log, with_rates),
                              "log" + std::to_string(paths.size()) + ".csv"));
  }
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  LogSet set(paths, reader, TimeRange());
  return CalibrateLinear(robot, options, &set, nullptr);
}

}  // namespace armcal
