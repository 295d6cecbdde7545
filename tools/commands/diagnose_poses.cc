#include "tools/commands/diagnose_poses.h"

#include <gflags/gflags.h>

#include <algorithm>

#include "calib/diagnose_poses.h"
#include "calib/poses/diagnosis/error_vectors.h"
#include "tools/command_report.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"
#include "tools/pose_flags.h"
#include "tools/report/report_data.h"
#include "tools/trust_flags.h"
#include "tools/usage_error.h"

DEFINE_string(compliance, "",
              "`FILE` diagnosis.json of logs: one over its stiffness is sag");

namespace armcal {
namespace {

using nlohmann::json;

// Error vectors that a picture has room for.
constexpr Eigen::Index kMostVectors = 300;

json RowsJson(const Eigen::MatrixX3d& vectors, Eigen::Index every) {
  json rows = json::array();
  for (Eigen::Index k = 0; k < vectors.rows(); k += every) {
    rows.push_back(RoundedJson(vectors.row(k).transpose()));
  }
  return rows;
}

// {joints: [{name, unit}], word, number, q: a list per joint, lengths:
// [[geometry, after]] of each target, pose by pose; of points also posture,
// thinned, at, geometry, after: [[x, y, z]] in the base frame}. m and rad.
json PoseErrorsJson(const Robot& robot, const PoseMeasurements& measured,
                    const PoseDiagnosis& diagnosis) {
  json drawn = {{"joints", json::array()},
                {"word", diagnosis.model.campaign.word},
                {"number", json::array()},
                {"q", json::array()},
                {"lengths", json::array()}};
  const auto& after = diagnosis.model.estimate.linear.r;
  const Eigen::Index width = after.size() / measured.size();
  const bool wire = measured.lengths.size() > 0;
  const Eigen::Index targets = std::max<Eigen::Index>(
      1, static_cast<Eigen::Index>(measured.targets.size()));
  for (const Link& link : robot.links) {
    drawn["joints"].push_back(
        {{"name", link.joint.name},
         {"unit", IsRotational(link.joint.type) ? "rad" : "m"}});
    drawn["q"].push_back(json::array());
  }
  for (Eigen::Index k = 0; k < measured.size(); ++k) {
    for (Eigen::Index t = 0; t < targets; ++t) {
      const auto length = [&](const Eigen::VectorXd& r) {
        return r.segment(k * width + 3 * t, wire ? 1 : 3).norm();
      };
      drawn["number"].push_back(diagnosis.model.campaign.number[k]);
      drawn["lengths"].push_back(
          {length(diagnosis.left_by_geometry), length(after)});
      for (size_t j = 0; j < robot.links.size(); ++j) {
        drawn["q"][j].push_back(measured.q(k, static_cast<Eigen::Index>(j)));
      }
    }
  }
  if (wire) return drawn;
  const PoseErrorVectors errors = ErrorVectorsOf(measured, diagnosis);
  const Eigen::Index every = 1 + errors.at.rows() / kMostVectors;
  drawn["posture"] = PosturesJson(robot, measured.q.topRows(1))[0];
  drawn["thinned"] = every;
  drawn["at"] = RowsJson(errors.at, every);
  drawn["geometry"] = RowsJson(errors.geometry, every);
  drawn["after"] = RowsJson(errors.after, every);
  return drawn;
}

}  // namespace

bool DiagnosesPoses(const CommandInput& input) {
  return !input.flags.Text("poses").empty();
}

CommandOutcome RunDiagnosePoses(const CommandInput& input) {
  const FlagValues& flags = input.flags;
  for (const char* other :
       {"log", "reference", "controller", "export", "modules"}) {
    if (flags.Text(other).empty()) continue;
    throw UsageError("--poses and --" + std::string(other) +
                     ": expected one of them; a diagnosis is of measured "
                     "poses or of logs");
  }
  const Robot robot = RobotFromFlags(input);
  const PoseMeasurements measured = PosesFromFlags(flags, robot);
  DiagnosePosesOptions options;
  const ArmTrust trust = TrustFromFlags(flags);
  options.geometry.prior_length = trust.length;
  options.geometry.prior_angle = trust.angle;
  options.without = SplitAtCommas(flags.Text("without"));
  const std::string held_out = flags.Text("validate");
  if (!held_out.empty()) {
    if (measured.instrument.size() > 0) {
      throw UsageError(
          "--validate: found images of several cameras or of lenses to be "
          "estimated in --poses; expected one camera with its intrinsics: "
          "--camera=camera.yaml of `armcal calibrate`");
    }
    options.validation = PosesFromFile(flags, robot, held_out);
  }
  options.calibration = flags.Text("calibration");
  options.compliance = flags.Text("compliance");
  options.gear_ratios = ParseNumbers("gear_ratios", flags.Text("gear_ratios"));
  options.source = RobotSourceFromFlags(input);
  options.progress = input.progress;
  const DiagnosePosesSummary summary = DiagnosePoses(robot, measured, options);
  CommandOutcome outcome = OutcomeOf(input, robot, summary, {});
  outcome.output.verdict = summary.brief;
  std::vector<std::string> files = {flags.Text("poses")};
  if (!held_out.empty()) files.push_back(held_out);
  if (!options.calibration.empty()) files.push_back(options.calibration);
  if (!options.compliance.empty()) files.push_back(options.compliance);
  for (const std::string& file : CameraFiles(flags)) files.push_back(file);
  AddReport(
      input, "diagnose", robot, summary.json, files,
      [&](ReportContent* content) {
        if (summary.verdict == PoseVerdictName(PoseVerdict::kNotTestable)) {
          return;
        }
        content->extra["pose_errors"] =
            PoseErrorsJson(robot, measured, *summary.details);
      },
      &outcome.folders[0]);
  return outcome;
}

}  // namespace armcal
