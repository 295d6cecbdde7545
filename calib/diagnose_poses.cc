#include "calib/diagnose_poses.h"

#include <algorithm>

#include "calib/poses/diagnosis/diagnosis.h"
#include "calib/poses/diagnosis/report.h"
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
  summary.json = PoseDiagnosisJson(robot, measured, *details).dump(2) + "\n";
  summary.files.push_back({"pose_diagnosis.json", summary.json});
  summary.details = std::move(details);
  return summary;
}

}  // namespace armcal
