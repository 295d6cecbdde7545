#include "tools/commands/calibrate_report.h"

#include <algorithm>

#include "tools/command_report.h"
#include "tools/input_flags.h"
#include "tools/report/report_data.h"

namespace armcal {
namespace {

using nlohmann::json;

std::vector<std::string> FilesOfCalibration(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  std::vector<std::string> files = LogsFromFlags(input);
  for (const std::vector<std::string>& more :
       {ValidationLogsFromFlags(input),
        SplitAtCommas(flags.Text("payload_log")),
        SplitAtCommas(flags.Text("poses"))}) {
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

std::vector<TracedModel> Models(const Robot& robot,
                                const CalibrationDrawing& drawing) {
  std::vector<TracedModel> models;
  const LinearCalibration& linear = drawing.linear;
  const auto& transitions = linear.transitions;
  const bool massive =
      std::any_of(robot.links.begin(), robot.links.end(),
                  [](const Link& link) { return link.inertial.mass > 0; });
  if (massive) models.push_back(TraceRobot("the robot file", robot, {}));
  models.push_back({"calibrated", linear.parameters, linear.x});
  if (drawing.refined != nullptr && drawing.refined->solved) {
    models.push_back(TraceRobot("calibrated, for a simulator",
                                drawing.refined->robot, transitions));
  }
  return models;
}

json Correlations(const CalibrationDrawing& drawing) {
  json list = json::array();
  const LinearCalibration& linear = drawing.linear;
  std::vector<std::string> names;
  for (const ModelParameter& p : linear.parameters.parameters()) {
    names.push_back(p.name);
  }
  list.push_back(CorrelationsJson("Model parameters", names, linear.covariance,
                                  linear.identifiable));
  if (drawing.refined == nullptr || !drawing.refined->solved) return list;
  names.clear();
  std::vector<bool> seen;
  for (const PhysicalParameter& p : drawing.refined->parameters) {
    names.push_back(p.name);
    seen.push_back(p.identifiable);
  }
  list.push_back(CorrelationsJson("The robot for a simulator", names,
                                  drawing.refined->covariance, seen));
  return list;
}

}  // namespace

json GeometryDrawing(const Robot& calibrated, const std::vector<double>& before,
                     const std::vector<double>& after) {
  json poses;
  if (!after.empty()) {
    poses = {{"before", RoundedJson(Eigen::Map<const Eigen::VectorXd>(
                            before.data(), static_cast<long>(before.size())))},
             {"after", RoundedJson(Eigen::Map<const Eigen::VectorXd>(
                           after.data(), static_cast<long>(after.size())))}};
  }
  return {{"skeleton", SkeletonJson(calibrated, BentPosture(calibrated))},
          {"poses", poses}};
}

void AddCalibrationReport(const CommandInput& input, const Robot& robot,
                          const std::string& result,
                          const CalibrationDrawing& drawing,
                          OutputFolder* out) {
  const auto complete = [&](ReportContent* content) {
    if (!drawing.linear.solved) return;
    content->torques = TracesJson(
        robot,
        DrawTorques(Models(robot, drawing), input.progress, drawing.logs));
    content->extra["correlations"] = Correlations(drawing);
    const NonlinearCalibration* refined = drawing.refined;
    if (refined == nullptr || !refined->solved || !refined->refined_geometry) {
      return;
    }
    const bool poses = refined->poses.has_value();
    content->extra["geometry"] = GeometryDrawing(
        refined->robot, poses ? refined->poses->before : std::vector<double>(),
        poses ? refined->poses->after : std::vector<double>());
  };
  AddReport(input, "calibrate", robot, result, FilesOfCalibration(input),
            complete, out);
}

}  // namespace armcal
