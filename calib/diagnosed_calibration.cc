#include "calib/diagnosed_calibration.h"

#include <memory>

#include "calib/refine/parameter_posterior.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Stand = GapDiagnosis::CalibrationsLogs;

DataFinding StandFor(Stand stand, const CalibrationLogs& own) {
  const std::string names = " (" + JoinNames(NamesOf(own.input.logs)) + ")";
  if (stand == Stand::kHaveItToo) {
    return {"the calibration's own logs have what is named as well" + names,
            "that is not new, the calibrated robot lacks it; whether anything "
            "else has changed since, this does not say",
            ""};
  }
  return {"the calibration's own logs are the reference" + names,
          "what they have as well is no change since", ""};
}

}  // namespace

std::optional<CalibratedRobot> ReadDiagnosedCalibration(
    const Robot& robot, const std::string& path, BaselineOptions* baseline) {
  if (path.empty()) return std::nullopt;
  const std::string file = CalibrationFile(path);
  CalibratedRobot calibrated = ReadCalibration(file, robot);
  baseline->posterior = std::make_shared<const ParameterPosterior>(
      ReadParameterPosterior(file, robot));
  baseline->transitions = calibrated.transitions;
  return calibrated;
}

CalibrationLogs ReadableLogs(const std::string& path,
                             const CalibratedRobot& calibrated,
                             const std::vector<LogSource>& used,
                             const LogReaderOptions& reading) {
  CalibrationLogs logs =
      FindCalibrationLogs(CalibrationFile(path), calibrated, used);
  if (logs.input.logs.empty()) return logs;
  try {
    LogSet(logs.input.logs, reading, logs.input.crop);
  } catch (const InputError& error) {
    return {{}, error.what()};
  }
  return logs;
}

void NoteCalibration(const CalibratedRobot& calibrated,
                     const CalibrationLogs& own,
                     const std::vector<const LogSet*>& used,
                     GapDiagnosis* diagnosis) {
  const std::string flag = OptionName("calibration");
  std::vector<DataFinding>& notes = diagnosis->data;
  if (!calibrated.converged) {
    notes.push_back({"the calibration had not converged",
                     "its numbers may be far from the logs'", flag});
  }
  for (const LogSet* logs : used) {
    for (int k = 0; logs != nullptr && k < logs->size(); ++k) {
      if (!calibrated.Saw(logs->path(k), logs->time_bases()[k].range)) continue;
      notes.push_back({"the calibration was fitted to " + logs->path(k),
                       "it agrees with that better than with other logs",
                       flag + " of other logs"});
    }
  }
  if (!own.missing.empty()) {
    notes.push_back(
        {"the calibration's own logs are not known",
         own.missing + ": what is named may be in them as well, or new",
         OptionName("reference") + " of them"});
  }
  if (diagnosis->calibrations_logs != Stand::kUnknown) {
    notes.push_back(StandFor(diagnosis->calibrations_logs, own));
  }
}

nlohmann::json CalibrationLogsJson(const GapDiagnosis& diagnosis) {
  switch (diagnosis.calibrations_logs) {
    case Stand::kHaveItToo:
      return "have_it_too";
    case Stand::kAreTheReference:
      return "reference";
    case Stand::kUnknown:
      break;
  }
  return nullptr;
}

}  // namespace armcal
