#include "calib/calibrated_robot.h"

#include "calib/refine/nonlinear_report.h"
#include "calib/robot_outputs.h"
#include "model/robot_files/urdf_writer.h"

namespace armcal {

void AddCalibratedRobot(const NonlinearCalibration& refined,
                        const std::optional<ControllerOptions>& controller,
                        const CalibrateOptions& options, nlohmann::json* json,
                        CalibrateSummary* summary) {
  summary->robot = refined.robot;
  summary->files.push_back(
      {"robot.urdf",
       RobotUrdf(options.source, refined.robot, refined.refined_geometry)});
  if (options.source.urdf) {
    summary->files.push_back(
        {"robot_without_meshes.urdf", MakeUrdf(refined.robot)});
  }
  summary->files.push_back(
      {"parameters_covariance.csv", ParametersCovarianceCsv(refined)});
  summary->files.push_back(
      {"parameters_posterior.csv", ParametersPosteriorCsv(refined)});
  for (const std::string& loss : UrdfLosses(refined.robot)) {
    summary->report += "robot.urdf  " + loss + "\n";
  }
  summary->report +=
      AddExports({refined.robot, {}, controller},
                 FormatsBesideUrdf(options.exports), json, &summary->files);
}

void SetParameters(const NonlinearCalibration& refined,
                   CalibrateSummary* summary) {
  summary->parameters.clear();
  for (const PhysicalParameter& p : refined.parameters) {
    summary->parameters.push_back({p.name, p.unit, p.value, p.stddev});
  }
  summary->covariance = refined.covariance;
}

}  // namespace armcal
