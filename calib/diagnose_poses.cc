#include "calib/diagnose_poses.h"

#include <algorithm>

#include "calib/poses/correction/correction_code.h"
#include "calib/poses/correction/pose_correction.h"
#include "calib/poses/diagnosis/compliance_reader.h"
#include "calib/poses/diagnosis/diagnosis.h"
#include "calib/poses/diagnosis/report.h"
#include "calib/poses/reading_audit.h"
#include "calib/refine/calibration_reader.h"
#include "calib/refine/parameter_posterior.h"
#include "calib/robot_outputs.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

void CheckPoseEffects(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto& effects = PoseEffects();
    const bool known = std::any_of(
        effects.begin(), effects.end(),
        [&](const PoseEffect& effect) { return effect.name == name; });
    if (known) continue;
    std::string all;
    for (const PoseEffect& effect : effects) {
      all += (all.empty() ? "" : ", ") + effect.name;
    }
    throw OptionError(OptionName("without") + ": found '" + name +
                      "', expected effects of " + "poses: " + all);
  }
}

void CheckGearRatios(const std::vector<double>& ratios, const Robot& robot) {
  const size_t joints = robot.links.size();
  if (ratios.empty() || ratios.size() == joints) return;
  throw OptionError(OptionName("gear_ratios") + ": found " +
                    std::to_string(ratios.size()) + " numbers, expected " +
                    std::to_string(joints) + ", one for each joint");
}

// The robot file's geometry, which its controller has, with the masses of a
// calibration.
Robot Weighed(Robot robot, const std::string& calibration) {
  const CalibratedRobot calibrated =
      ReadCalibration(CalibrationFile(calibration), robot);
  for (size_t k = 0; k < robot.links.size(); ++k) {
    robot.links[k].inertial = calibrated.robot.links[k].inertial;
  }
  return robot;
}

void AddCorrection(const PoseMeasurements& measured,
                   const PoseDiagnosis& diagnosis,
                   const DiagnosePosesOptions& options, nlohmann::json* json,
                   DiagnosePosesSummary* summary) {
  if (options.progress) options.progress("correcting joint positions", -1);
  const PoseCorrection correction =
      CorrectFromPoses(measured, diagnosis.model,
                       options.validation ? &*options.validation : nullptr);
  (*json)["correction"] = CorrectionJson(correction);
  summary->report += CorrectionText(correction, diagnosis.gap.held_out_after);
  summary->files.push_back(
      {"correction.c", CorrectionCode(correction.arm, correction.errors)});
  if (TableHelps(correction.errors)) {
    summary->files.push_back(
        {"correction.csv", CorrectionCsv(correction.arm, correction.table)});
  }
  summary->report += AddRobotUrdf(options.source, correction.arm.links(), true,
                                  &summary->files);
}

}  // namespace

DiagnosePosesSummary DiagnosePoses(const Robot& robot,
                                   const PoseMeasurements& measured,
                                   const DiagnosePosesOptions& options) {
  CheckPoseEffects(options.without);
  CheckGearRatios(options.gear_ratios, robot);
  if (measured.tilts.size() > 0) {
    throw OptionError(OptionName("poses") +
                      ": found tilts, expected poses, targets, wire lengths or "
                      "images: an inclinometer tells no positions");
  }
  if (!measured.touched.empty()) {
    throw OptionError(OptionName("poses") +
                      ": found touched points, expected poses, targets, wire "
                      "lengths or images: too many effects look like another "
                      "point");
  }
  // A joint that counts the other way is a gear ratio of -1.
  constexpr auto kTurned = TurnedJoints::kAreFindings;
  RequireReading(robot, measured, "poses", kTurned);
  if (options.validation) {
    RequireReading(robot, *options.validation, "validate", kTurned);
  }
  PoseDiagnosisOptions search;
  search.geometry = options.geometry;
  search.without = options.without;
  search.weighed = !options.calibration.empty();
  search.gear_ratios = options.gear_ratios;
  if (!options.compliance.empty()) {
    if (!search.weighed) {
      throw OptionError(OptionName("compliance") + ": expected " +
                        OptionName("calibration") +
                        " beside it: compliance is told per N m");
    }
    search.compliance = ReadCompliance(options.compliance, robot);
  }
  search.progress = options.progress;
  const Robot arm =
      search.weighed ? Weighed(robot, options.calibration) : robot;
  auto details =
      std::make_shared<PoseDiagnosis>(DiagnosePoseGap(arm, measured, search));
  // Where the ratio of -1 is too far away for a fit to be found.
  if (details->verdict == PoseVerdict::kNotTestable) {
    RequireReading(robot, measured, "poses");
  }
  DiagnosePosesSummary summary;
  summary.verdict = PoseVerdictName(details->verdict);
  for (const PoseFinding& finding : details->findings) {
    if (IsNamed(finding)) summary.effects.push_back(finding.name);
  }
  summary.positive = details->verdict == PoseVerdict::kNoiseFloor;
  summary.brief = PoseSentence(*details);
  summary.report = PoseDiagnosisReport(robot, measured, *details);
  nlohmann::json json = PoseDiagnosisJson(robot, measured, *details);
  if (details->verdict != PoseVerdict::kNotTestable) {
    AddCorrection(measured, *details, options, &json, &summary);
  }
  summary.json = json.dump(2) + "\n";
  summary.files.push_back({"pose_diagnosis.json", summary.json});
  summary.details = std::move(details);
  return summary;
}

}  // namespace armcal
