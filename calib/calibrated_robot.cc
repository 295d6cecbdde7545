#include "calib/calibrated_robot.h"

#include "calib/refine/nonlinear_report.h"
#include "calib/refine/robot_draws.h"
#include "calib/robot_outputs.h"
#include "model/robot_files/urdf_writer.h"

namespace armcal {
namespace {

// samples.csv and samples/robot_01.urdf .., in every format that is asked for.
void AddDrawnRobots(const NonlinearCalibration& refined,
                    const std::optional<ControllerOptions>& controller,
                    const CalibrateOptions& options, nlohmann::json* json,
                    CalibrateSummary* summary) {
  const RobotDraws draws = DrawRobots(refined, options.samples);
  const auto formats = FormatsBesideUrdf(options.exports);
  summary->files.push_back({"samples.csv", RobotDrawsCsv(draws)});
  for (int r = 0; r < options.samples; ++r) {
    const Robot& robot = draws.robots[r];
    const auto add = [&](const std::string& file, const std::string& text) {
      summary->files.push_back({SampleFile(file, r, options.samples), text});
    };
    add("robot.urdf",
        RobotUrdf(options.source, robot, refined.refined_geometry).text);
    for (const RobotFormat* format : formats) {
      add(format->file, format->write({robot, {}, controller}));
    }
  }
  summary->report += AddSamples(options.samples, json);
}

}  // namespace

void AddCalibratedRobot(const NonlinearCalibration& refined,
                        const std::optional<ControllerOptions>& controller,
                        const CalibrateOptions& options, nlohmann::json* json,
                        CalibrateSummary* summary) {
  summary->robot = refined.robot;
  const std::string losses = AddRobotUrdf(
      options.source, refined.robot, refined.refined_geometry, &summary->files);
  if (options.source.urdf) {
    summary->files.push_back(
        {"robot_without_meshes.urdf", MakeUrdf(refined.robot)});
  }
  summary->files.push_back(
      {"parameters_covariance.csv", ParametersCovarianceCsv(refined)});
  summary->files.push_back(
      {"parameters_posterior.csv", ParametersPosteriorCsv(refined)});
  summary->report += losses;
  summary->report +=
      AddExports({refined.robot, {}, controller},
                 FormatsBesideUrdf(options.exports), json, &summary->files);
  if (options.samples > 0) {
    AddDrawnRobots(refined, controller, options, json, summary);
  }
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
