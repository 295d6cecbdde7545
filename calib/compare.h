#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/compare/compared_result.h"
#include "calib/log_input.h"
#include "calib/summary.h"
#include "model/log_files/log_reader_options.h"
#include "model/text/progress.h"

namespace armcal {

struct CompareOptions {
  RobotReader read_robot;      // of results that are robot files
  std::optional<Robot> robot;  // that the calibrations are of, for logs
  LogInput logs;             // to predict torques of; none: no figures of them
  LogReaderOptions reading;  // of the logs
  std::optional<double> bandwidth_hz;  // for them; not given: of the motion
  Progress progress;
};

struct CompareSummary : Summary {
  std::string robot;  // the first result's
};

// Whether two or more results of one robot agree within noise: calibrations,
// diagnoses or verifications among each other, robot files among each other and
// beside calibrations. `results`: paths of the files, or of folders that hold
// one. Throws InputError and OptionError.
CompareSummary Compare(const std::vector<std::string>& results,
                       const CompareOptions& options);

}  // namespace armcal
