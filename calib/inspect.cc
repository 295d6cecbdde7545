#include "calib/inspect.h"

#include "calib/inspect/inspection_report.h"
#include "calib/inspect/robot_audit.h"
#include "calib/logs/torque_trace.h"
#include "calib/robot_outputs.h"
#include "model/log_files/log_writer.h"
#include "model/robot_files/controller_reader.h"
#include "model/robot_files/urdf_tree.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

LogInspection InspectWhole(const Robot& robot, const LogSource& source,
                           const LogReaderOptions& reading, int drawn_bins) {
  LogInspection log = InspectLog(robot, source, reading, drawn_bins);
  if (!log.as_it_is) return log;
  log.coverage = CoverageOf(robot, source, reading);
  log.findings.insert(log.findings.end(), log.coverage.findings.begin(),
                      log.coverage.findings.end());
  return log;
}

std::string NameOfMended(size_t log) {
  return "fixed_" + std::to_string(log + 1) + ".csv";
}

// "`fix` writes the log so" is "fixed_1.csv is the log so" once it is written.
void TellWhatIsMended(const std::string& file,
                      std::vector<InspectionFinding>* findings) {
  const std::string would = OptionName("fix"), writes = would + " writes";
  for (InspectionFinding& finding : *findings) {
    std::string& remedy = finding.remedy;
    const size_t at = remedy.find(would);
    if (at == remedy.npos) continue;
    const bool is_verb = remedy.compare(at, writes.size(), writes) == 0;
    remedy.replace(at, (is_verb ? writes : would).size(),
                   file + (is_verb ? " is" : ""));
  }
}

std::string MendedText(const Robot& robot, const LogSource& source,
                       const LogReaderOptions& reading,
                       const LogInspection& inspection) {
  LogReaderOptions wanted = reading;
  wanted.want_velocity = wanted.commands_do = true;
  return LogText(Mended(robot, ReadWholeLog(source, wanted), inspection));
}

RobotDescription Describe(const Robot& robot, const InspectOptions& options) {
  if (options.controller.empty()) return {robot, {}};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(robot.num_joints());
  return {robot, {}, ReadController(options.controller, robot, zero)};
}

}  // namespace

InspectSummary Inspect(const Robot& robot, const std::vector<LogSource>& logs,
                       const InspectOptions& options) {
  const auto formats = FormatsNamed(options.exports);
  const auto begin = [&](const std::string& stage) {
    if (options.progress) options.progress(stage, -1);
  };
  begin("inspecting");
  InspectSummary summary;
  summary.of_robot =
      AuditRobot(robot, options.urdf ? WideAngles(*options.urdf)
                                     : std::vector<std::string>());
  summary.positive = summary.of_robot.empty();
  LogReaderOptions reading = options.reading;
  reading.joint_names = robot.JointNames();
  std::vector<LogInspection> inspected;
  const int most_bins =
      MostTraceBins(static_cast<int>(logs.size()), robot.num_joints(), 2);
  for (const LogSource& source : logs) {
    begin("inspecting " + source.name);
    const bool drawn = options.draw && inspected.size() < kMostDrawnLogs;
    inspected.push_back(
        InspectWhole(robot, source, reading, drawn ? most_bins : 0));
    LogInspection& log = inspected.back();
    if (options.mend) {
      TellWhatIsMended(NameOfMended(inspected.size() - 1), &log.findings);
    }
    summary.logs.push_back(
        {source.name, log.as_it_is, log.findings, log.drawing});
    summary.positive = summary.positive && log.findings.empty();
  }
  nlohmann::json json = ToJson(robot, summary.of_robot, inspected);
  const std::string losses =
      AddExports(Describe(robot, options), formats, &json, &summary.files);
  summary.json = json.dump(2) + "\n";
  summary.files.push_back({"inspect.json", summary.json});
  // Numbers in their names: logs of different folders may have one name.
  for (size_t k = 0; options.mend && k < logs.size(); ++k) {
    summary.files.push_back(
        {NameOfMended(k), MendedText(robot, logs[k], reading, inspected[k])});
  }
  summary.report = FullReport(robot, summary.of_robot, inspected) + losses;
  return summary;
}

}  // namespace armcal
