#include "tools/commands/calibrate_report.h"

#include "tools/report/report_data.h"

namespace armcal {
namespace {

using nlohmann::json;

json CorrelationsOf(const std::string& title,
                    const NonlinearCalibration& refined) {
  std::vector<std::string> names;
  std::vector<bool> seen;
  for (const PhysicalParameter& p : refined.parameters) {
    names.push_back(p.name);
    seen.push_back(p.identifiable);
  }
  return CorrelationsJson(title, names, refined.covariance, seen);
}

json CorrelationsOf(const LinearCalibration& linear) {
  std::vector<std::string> names;
  for (const ModelParameter& p : linear.parameters.parameters()) {
    names.push_back(p.name);
  }
  return CorrelationsJson("Model parameters", names, linear.covariance,
                          linear.identifiable);
}

json DistancesJson(const std::vector<double>& distances) {
  return RoundedJson(Eigen::Map<const Eigen::VectorXd>(
      distances.data(), static_cast<long>(distances.size())));
}

// {skeleton, poses}: a calibrated geometry, and distances of poses before and
// after, m.
json GeometryDrawing(const Robot& calibrated, const std::vector<double>& before,
                     const std::vector<double>& after) {
  json poses;
  if (!after.empty()) {
    poses = {{"before", DistancesJson(before)},
             {"after", DistancesJson(after)}};
  }
  return {{"skeleton", SkeletonJson(calibrated, BentPosture(calibrated))},
          {"poses", poses}};
}

void DrawRefined(const NonlinearCalibration& refined, json* extra) {
  (*extra)["correlations"].push_back(
      CorrelationsOf("The robot for a simulator", refined));
  if (!refined.refined_geometry) return;
  const PoseFigures none, &poses = refined.poses ? *refined.poses : none;
  (*extra)["geometry"] =
      GeometryDrawing(refined.robot, poses.before, poses.after);
}

}  // namespace

void DrawCalibration(const Robot& robot, const CalibrationDetails& details,
                     ReportContent* content) {
  json& extra = content->extra;
  if (details.linear && details.linear->solved) {
    content->torques = TracesJson(robot, details.torques);
    extra["correlations"] = json::array({CorrelationsOf(*details.linear)});
    if (details.refined && details.refined->solved) {
      DrawRefined(*details.refined, &extra);
    }
  }
  if (details.poses && details.poses->solved) {
    extra["geometry"] = GeometryDrawing(
        details.poses->robot, details.poses->before, details.poses->after);
  }
  if (details.commanded && details.commanded->arm.solved) {
    extra["positions"] = PositionsJson(robot, {"the robot file", "calibrated"},
                                       details.commanded->traces);
    extra["correlations"] = json::array(
        {CorrelationsOf("The robot and its drives", details.commanded->arm)});
  }
}

}  // namespace armcal
