#include "calib/poses/calibrate_poses.h"

#include "calib/calibrate_parts.h"
#include "calib/calibration_details.h"
#include "calib/poses/cross_validation.h"
#include "calib/poses/reading_audit.h"
#include "calib/poses/report.h"
#include "calib/poses/verdict.h"
#include "calib/robot_outputs.h"
#include "model/camera/camera_file.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// camera.yaml, or camera1.yaml and so on, of lenses that were estimated.
void AddCameras(const PoseMeasurements& measured, const PoseCalibration& result,
                std::vector<ResultFile>* files) {
  for (const EstimatedCamera& estimated : measured.cameras) {
    PinholeCamera::Lens lens;
    for (int k = 0; k < PinholeCamera::kLensSize; ++k) {
      lens[k] = result.instrument[estimated.first + k].value;
    }
    PinholeCamera camera = estimated.camera;
    camera.set_lens(lens);
    files->push_back(
        {estimated.name + ".yaml", CameraYaml(camera, estimated.name)});
  }
}

// What was fitted of the instrument has to be that of the poses held out.
void CheckValidation(const PoseMeasurements& measured,
                     const PoseMeasurements& validation) {
  if (measured.instrument.size() > 0 || !measured.touched.empty()) {
    throw OptionError(
        OptionName("validate") + ": found " +
        (measured.touched.empty() ? "cameras to be estimated" : "touches") +
        " in " + OptionName("poses") +
        ", expected poses, targets, wire lengths, tilts or images of one known "
        "camera: others stand for nothing in another file");
  }
  if (measured.kind() != validation.kind() ||
      measured.targets.size() != validation.targets.size()) {
    throw OptionError(OptionName("validate") + ": expected what " +
                      OptionName("poses") +
                      " has, measured in the same way: its columns differ");
  }
}

}  // namespace

CalibrateSummary CalibrateFromPoses(const Robot& robot,
                                    const CalibrateOptions& options) {
  PoseCalibrationOptions fit;
  fit.refine = options.geometry;
  const auto formats = FormatsBesideUrdf(options.exports);
  if (options.samples > 0) {
    throw OptionError(OptionName("export") +
                      ": found samples, expected formats alone: measured "
                      "poses tell nothing of masses to draw from; give a " +
                      OptionName("log") + " beside them");
  }
  if (options.pose_validation) {
    CheckValidation(*options.poses, *options.pose_validation);
    fit.validation = &*options.pose_validation;
  }
  fit.prior_length = options.trust.length;
  fit.prior_angle = options.trust.angle;
  if (options.progress) options.progress("fitting the poses", -1);
  RequireReading(robot, *options.poses, "poses");
  if (options.pose_validation) {
    RequireReading(robot, *options.pose_validation, "validate");
  }
  fit.loss = options.equations.loss
                 ? *options.equations.loss
                 : ChoosePoseLoss(robot, *options.poses, fit);
  auto details = std::make_shared<CalibrationDetails>();
  const PoseCalibration& result =
      details->poses.emplace(CalibratePoses(robot, *options.poses, fit));
  CalibrateSummary summary;
  summary.solved = result.solved;
  nlohmann::json json = PoseJson(robot, *options.poses, result);
  summary.report = PoseReport(robot, *options.poses, result);
  if (result.solved) {
    summary.robot = result.robot;
    summary.report +=
        AddRobotUrdf(options.source, result.robot, true, &summary.files);
    summary.report +=
        AddExports({result.robot, {}}, formats, &json, &summary.files);
    AddCameras(*options.poses, result, &summary.files);
  }
  for (const GeometryEstimate& p : result.parameters) {
    summary.parameters.push_back({p.name, p.unit, p.value, p.stddev});
  }
  summary.json = json.dump(2) + "\n";
  summary.files.push_back({"calibration.json", summary.json});
  summary.positive = Shortcomings(robot, result).empty();
  summary.details = std::move(details);
  return summary;
}

}  // namespace armcal
