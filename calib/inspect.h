#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/inspect/log_drawing.h"
#include "calib/logs/inspection_finding.h"
#include "calib/summary.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"
#include "model/robot/robot.h"
#include "model/text/document.h"
#include "model/text/progress.h"

namespace armcal {

struct InspectOptions {
  // How the torques of logs are read; joint_names are the robot's.
  LogReaderOptions reading;
  // Adds the logs as they are understood, in order, signs and units:
  // fixed_1.csv ..
  bool mend = false;
  std::vector<std::string> exports;  // formats to write the robot in: "mjcf" ..
  // Path of the drives' law that goes into the exports (docs/simulate.md); the
  // gains that it leaves open are those of the posture of zeros. Empty: none.
  std::string controller;
  // The URDF that the robot was read from, of which it is asked whether angles
  // are in rad; none: nothing is asked of that.
  std::optional<Document> urdf;
  bool draw = false;  // keeps what a page draws of the first 30 logs
  Progress progress;
};

// A log that was inspected.
struct InspectedLog {
  std::string name;
  bool as_it_is = false;  // its torques fit the robot best as logged
  std::vector<InspectionFinding> findings;
  LogDrawing drawing;  // of InspectOptions::draw
};

struct InspectSummary : Summary {
  std::vector<InspectionFinding> of_robot;
  std::vector<InspectedLog> logs;
};

// What a robot and logs of it hold, and what is wrong with them: it is positive
// where nothing is. Throws InputError for what cannot be read at all, and
// OptionError.
InspectSummary Inspect(const Robot& robot, const std::vector<LogSource>& logs,
                       const InspectOptions& options);

}  // namespace armcal
