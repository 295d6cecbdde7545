#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calib/calibration_logs.h"
#include "calib/diagnose/diagnosis.h"
#include "calib/refine/calibration_reader.h"
#include "model/log_files/log_reader_options.h"

namespace armcal {

// The calibrated robot of a diagnosis, with the posterior as the baseline's;
// none where there is no path. Throws InputError.
std::optional<CalibratedRobot> ReadDiagnosedCalibration(
    const Robot& robot, const std::string& path, BaselineOptions* baseline);

// FindCalibrationLogs of the calibration at `path`; none, with the reason,
// where they cannot be read as `reading` says.
CalibrationLogs ReadableLogs(const std::string& path,
                             const CalibratedRobot& calibrated,
                             const std::vector<LogSource>& used,
                             const LogReaderOptions& reading);

// What is said of a diagnosis because of the calibration that it began with:
// one that had not converged, logs that are its own (they would count twice:
// it agrees with them better than with others), and what its own logs stood
// for.
void NoteCalibration(const CalibratedRobot& calibrated,
                     const CalibrationLogs& own,
                     const std::vector<const LogSet*>& used,
                     GapDiagnosis* diagnosis);

// What these stood for: "have_it_too", "reference" or null.
nlohmann::json CalibrationLogsJson(const GapDiagnosis& diagnosis);

}  // namespace armcal
