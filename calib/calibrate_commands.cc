#include <algorithm>
#include <cmath>

#include "calib/calibrate_parts.h"
#include "calib/calibrated_robot.h"
#include "calib/calibration_details.h"
#include "calib/closed_loop/output_error_report.h"
#include "calib/inspect/stuck_rows.h"
#include "calib/linear/calibrate_linear.h"
#include "calib/log_doubts.h"
#include "calib/log_readings.h"
#include "model/robot_files/controller_reader.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

double NotNegative(const std::string& option, double value) {
  if (value >= 0 && std::isfinite(value)) return value;
  throw OptionError(OptionName(option) + ": found '" + NumberText(value) +
                    "', expected a standard deviation of at least 0");
}

OutputErrorOptions FitOptions(const CalibrateOptions& options) {
  if (options.geometry != RefineGeometry::kNothing || options.poses ||
      options.equations.geometry != GeometryKnowledge::kKnown) {
    throw OptionError(OptionName("controller") + ": found " +
                      OptionName("geometry") + " or " + OptionName("poses") +
                      " beside it, expected none: commands are followed by an "
                      "arm of known geometry");
  }
  OutputErrorOptions fit;
  fit.trust.inertia = options.trust.inertia;
  fit.trust.gains = NotNegative("gains_trust", options.commands->gains_trust);
  fit.trust.delay = NotNegative("delay_trust", options.commands->delay_trust);
  fit.joint_terms = options.equations.joint_terms;
  fit.progress = options.progress;
  if (const auto& transition = options.equations.transition) {
    if (transition->law != CoulombTransition::Law::kVelocity) {
      throw OptionError(OptionName("coulomb_width") +
                        ": found a displacement, expected a speed: commands "
                        "are followed by an arm with friction of velocity");
    }
    fit.coulomb_width = transition->width;
    fit.trust.width = 0;
  }
  return fit;
}

void ExpectMasses(const Robot& robot, const CalibrateOptions& options) {
  for (const Link& link : robot.links) {
    // A link between two joints of one body is held at no mass (ArmUnknowns).
    if (link.inertial.mass > 0 || IsDeclaredMassless(link)) continue;
    throw InputError(
        options.source.name.empty() ? robot.name : options.source.name,
        "link " + link.name, "",
        "expected a mass: a simulation starts from it");
  }
}

std::vector<CommandedLog> Read(const LogInput& input,
                               const LogReaderOptions& reading) {
  std::vector<CommandedLog> logs;
  for (const LogSource& log : input.logs) {
    logs.push_back(ReadCommandedLog(log, reading, input.crop));
  }
  return logs;
}

void CheckTorqueLogs(const LogInput& logs, const CalibrateOptions& options) {
  const std::vector<LogSource>& torques = options.commands->torque_logs;
  const std::vector<std::string> names = NamesOf(torques);
  const bool gap = std::count(names.begin(), names.end(), "") > 0;
  if (!gap && NamedBefore(logs, options.validation, torques).empty()) return;
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ",") + name;
  throw OptionError(OptionName("torque_log") + ": found '" + all +
                    "', expected names of logs that are named once, with "
                    "commas between them");
}

// What is wrong with positions is not read: of commands and of torques.
std::vector<DataFinding> Mend(const Robot& robot, const LogInput& logs,
                              const CalibrateOptions& options,
                              LogReaderOptions* reading) {
  LogInput torques;
  torques.logs = options.commands->torque_logs;
  return MendPositions(robot, UsedParts({&logs, &options.validation, &torques}),
                       reading);
}

// What logs with torques of the same arm tell; nothing without them.
std::optional<TorqueInformation> InformByTorqueLogs(
    const Robot& robot, const CalibrateOptions& options,
    const LogReaderOptions& reading) {
  const std::vector<LogSource>& torques = options.commands->torque_logs;
  if (torques.empty()) return std::nullopt;
  const LinearCalibrationOptions& linear = options.equations;
  if (linear.identification != Identification::kWeak ||
      linear.solver != LinearSolver::kWeighted) {
    throw OptionError(OptionName("torque_log") + ": expected " +
                      OptionName("identification") + "=weak and " +
                      OptionName("solver") +
                      "=weighted with it, whose equations have weights beside "
                      "positions");
  }
  NonlinearCalibrationOptions fit;
  fit.trust = options.trust;
  fit.progress = options.progress;
  const LogSet logs(torques, reading, TimeRange());
  return InformByTorques(robot, CalibrateLinear(robot, linear, logs, nullptr),
                         fit, logs);
}

}  // namespace

CalibrateSummary CalibrateFromCommands(const Robot& robot, const LogInput& logs,
                                       const CalibrateOptions& options) {
  OutputErrorOptions fit = FitOptions(options);
  ExpectMasses(robot, options);
  CheckApart(logs, options.validation);
  CheckTorqueLogs(logs, options);
  if (options.progress) options.progress("opening the logs", -1);
  LogReaderOptions with_torques = options.reading;
  const std::vector<DataFinding> mended =
      Mend(robot, logs, options, &with_torques);
  LogReaderOptions reading = with_torques;
  reading.need_torque = false;
  const std::vector<CommandedLog> training = Read(logs, reading);
  const std::vector<CommandedLog> validation =
      Read(options.validation, reading);
  const ControllerOptions controller = ReadController(
      options.commands->controller, robot, training.at(0).log.qref.row(0));
  if (options.draw_torques) {
    const auto drawn = validation.empty() ? training.size() : validation.size();
    fit.trace_bins =
        MostTraceBins(static_cast<int>(drawn), robot.num_joints(), 2);
  }
  const std::optional<TorqueInformation> torques =
      InformByTorqueLogs(robot, options, with_torques);
  auto details = std::make_shared<CalibrationDetails>();
  const OutputErrorCalibration& result = details->commanded.emplace(
      CalibrateOutputError(robot, controller, fit, training, validation,
                           torques ? &*torques : nullptr));
  CalibrateSummary summary;
  summary.solved = result.arm.solved;
  nlohmann::json json = OutputErrorJson(robot, training, validation, result);
  if (torques) {
    const auto names = NamesOf(options.commands->torque_logs);
    json["torque_logs"] = names;
    summary.report = "with the torques of " + JoinNames(names) + "\n";
  }
  summary.report += OutputErrorReport(robot, result);
  SetParameters(result.arm, &summary);
  if (result.arm.solved) {
    ControllerOptions drives = controller;
    drives.drives = result.values.drives;
    drives.delay = result.values.delay;
    AddCalibratedRobot(result.arm, drives, options, &json, &summary);
  }
  if (!mended.empty()) TellFirst(mended, &json, &summary);
  summary.json = json.dump(2) + "\n";
  summary.files.push_back({"calibration.json", summary.json});
  summary.positive = Shortcomings(result).empty();
  summary.details = std::move(details);
  return summary;
}

}  // namespace armcal
