#include "calib/diagnose_poses.h"

#include <algorithm>

#include "calib/poses/correction/correction_code.h"
#include "calib/poses/correction/pose_correction.h"
#include "calib/poses/diagnosis/diagnosis.h"
#include "calib/poses/diagnosis/report.h"
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

void AddCorrection(const Robot& robot, const PoseMeasurements& measured,
                   const PoseDiagnosis& diagnosis,
                   const DiagnosePosesOptions& options, nlohmann::json* json,
                   DiagnosePosesSummary* summary) {
  if (options.progress) options.progress("correcting joint positions", -1);
  const PoseCorrection correction =
      CorrectFromPoses(robot, measured, diagnosis.model,
                       options.validation ? &*options.validation : nullptr);
  (*json)["correction"] = CorrectionJson(correction);
  summary->report += CorrectionText(correction);
  summary->files.push_back(
      {"correction.c", CorrectionCode(correction.arm, correction.errors)});
  if (TableHelps(correction.errors)) {
    summary->files.push_back(
        {"correction.csv", CorrectionCsv(correction.arm, correction.table)});
  }
  summary->files.push_back(
      {"robot.urdf", RobotUrdf(options.source, correction.arm.links(), true)});
}

}  // namespace

DiagnosePosesSummary DiagnosePoses(const Robot& robot,
                                   const PoseMeasurements& measured,
                                   const DiagnosePosesOptions& options) {
  CheckPoseEffects(options.without);
  if (!measured.touched.empty()) {
    throw OptionError(OptionName("poses") +
                      ": found touched points, expected poses, targets, wire "
                      "lengths or images: too many effects look like another "
                      "point");
  }
  PoseDiagnosisOptions search;
  search.geometry = options.geometry;
  search.without = options.without;
  search.progress = options.progress;
  auto details =
      std::make_shared<PoseDiagnosis>(DiagnosePoseGap(robot, measured, search));
  DiagnosePosesSummary summary;
  summary.verdict = PoseVerdictName(details->verdict);
  for (const PoseFinding& finding : details->findings) {
    summary.effects.push_back(finding.name);
  }
  summary.positive = details->verdict == PoseVerdict::kNoiseFloor;
  summary.brief = PoseSentence(*details);
  summary.report = PoseDiagnosisReport(robot, measured, *details);
  nlohmann::json json = PoseDiagnosisJson(robot, measured, *details);
  if (details->verdict != PoseVerdict::kNotTestable) {
    AddCorrection(robot, measured, *details, options, &json, &summary);
  }
  summary.json = json.dump(2) + "\n";
  summary.files.push_back({"pose_diagnosis.json", summary.json});
  summary.details = std::move(details);
  return summary;
}

}  // namespace armcal
