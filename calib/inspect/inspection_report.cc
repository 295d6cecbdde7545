#include "calib/inspect/inspection_report.h"

#include <algorithm>

#include "calib/inspect/robot_audit.h"
#include "calib/inspect/robot_description.h"
#include "calib/numerics/json_figures.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using nlohmann::json;

std::string FindingText(const InspectionFinding& finding) {
  std::string text = "  ! " + finding.sentence;
  if (finding.probability < .995) {
    text += finding.probability < .01
                ? " (probability below .01)"
                : Format(" (probability %.2f)", finding.probability);
  }
  return text + "\n      " + finding.evidence + "\n      " + finding.remedy +
         "\n";
}

std::string CoverageText(const Robot& robot, const LogCoverage& coverage) {
  if (!coverage.known) {
    return coverage.reason.empty()
               ? ""
               : "  what it can tell: nothing yet, " + coverage.reason + "\n";
  }
  std::string text = "  time: " + coverage.time_base;
  if (coverage.stamp_wander > 1e-3) {
    text += Format("; stamps depart from even sampling by up to %.1f ms",
                   1e3 * coverage.stamp_wander);
  }
  text += Format(
      "\n  calibrated on it, the model leaves %.3g %%; noise is told from %s\n",
      coverage.residual_percent, coverage.noise_source.c_str());
  if (!coverage.too_short.empty()) {
    text += "  " + coverage.too_short + "\n";
  }
  for (const UnpoweredJoint& joint : coverage.unpowered) {
    const Joint& of = robot.links[joint.joint].joint;
    text += "  the torque of " + of.name +
            Format(", %.3g %s rms", joint.torque_rms, EffortUnit(of.type)) +
            ", is next to nothing beside gravity and inertia of the file's "
            "links: in another unit, or borne by something else\n";
  }
  text += Format("  %d of %d directions of the model parameters show\n",
                 coverage.rank, coverage.total);
  constexpr size_t kShown = 3;  // a short log leaves dozens open
  const std::vector<std::string>& unseen = coverage.unseen;
  for (size_t k = 0; k < std::min(kShown, unseen.size()); ++k) {
    text += "    not seen: " + unseen[k] + "\n";
  }
  if (unseen.size() > kShown) {
    text += Format("    ... and %zu more (in inspect.json)\n",
                   unseen.size() - kShown);
  }
  if (!coverage.advice.empty()) {
    text += "    to see more: " + coverage.advice + ", or armcal excite " +
            OptionName("given") + "\n";
  }
  return text;
}

json CoverageJson(const Robot& robot, const LogCoverage& coverage) {
  if (!coverage.known) return {{"known", false}, {"reason", coverage.reason}};
  json unpowered = json::array();
  for (const UnpoweredJoint& joint : coverage.unpowered) {
    unpowered.push_back({{"joint", robot.links[joint.joint].joint.name},
                         {"torque_rms", JsonNumber(joint.torque_rms)}});
  }
  return {{"known", true},
          {"rank", coverage.rank},
          {"total", coverage.total},
          {"unseen", coverage.unseen},
          {"unpowered", std::move(unpowered)},
          {"advice", coverage.advice},
          {"residual_percent", JsonNumber(coverage.residual_percent)},
          {"outliers", coverage.outliers},
          {"too_short", coverage.too_short},
          {"noise_source", coverage.noise_source},
          {"stamp_wander", JsonNumber(coverage.stamp_wander)}};
}

// Where the torque is from.
std::string TorqueText(const LogInspection& log) {
  if (!log.torque_source.empty()) return log.torque_source;
  std::string text = "none";
  if (!log.unscaled.columns.empty()) {
    text += "; " + log.unscaled.what + " (" + log.unscaled.columns +
            ") that need " + OptionName("torque_constants");
  }
  if (log.tracking_rms.size() > 0) {
    text += "; commands (qref) that " + OptionName("controller") +
            " lets a simulated robot follow";
  }
  return text;
}

// A wrong reading is told where another is clearly better; that none of them
// makes the torque this arm's is no finding about a column. Noise as large as
// the torque looks the same.
std::string NothingFound(const LogInspection& log) {
  if (log.ExplainsTorque()) return "  nothing wrong was found\n";
  return "  nothing wrong was found, but no reading makes this arm explain its "
         "torque, of which the best fit leaves more than it explains:\n"
         "  is it this arm's, of this motion, and above its noise?\n";
}

std::string LogText(const Robot& robot, const LogInspection& log) {
  std::string text = log.path + "\n";
  text += Format("  %d rows in %.4g s, a step of %.4g ms, %.0f %% in motion\n",
                 log.rows, log.duration, 1e3 * log.stamps.mean_step,
                 100 * log.moving_share);
  if (!log.whole) text += "  only these first rows were looked at\n";
  if (log.stamps.duplicates > 0) {
    text += Format("  %ld rows have the time of the row before\n",
                   log.stamps.duplicates);
  }
  if (log.stamps.longest_gap > 3 * log.stamps.mean_step) {
    text +=
        Format("  the longest step is %.4g ms\n", 1e3 * log.stamps.longest_gap);
  }
  if (!log.spelling.empty()) text += "  its columns: " + log.spelling + "\n";
  text += "  torque: " + TorqueText(log);
  if (log.residual_percent > 0) {
    text += Format("; the best fit of this arm leaves %.3g %%",
                   log.residual_percent);
  }
  text += "\n";
  for (int j = 0; j < log.top_speed.size(); ++j) {
    const Joint& joint = robot.links[j].joint;
    text += Format("    %-24s travels %7.3g %s, up to %6.3g %s/s",
                   joint.name.c_str(), log.travel[j], PositionUnit(joint.type),
                   log.top_speed[j], PositionUnit(joint.type));
    if (log.torque_source.empty() && log.tracking_rms.size() > 0) {
      text += Format(", %.3g %s rms off its command", log.tracking_rms[j],
                     PositionUnit(joint.type));
    }
    text += "\n";
  }
  text += CoverageText(robot, log.coverage);
  for (const InspectionFinding& finding : log.findings) {
    text += FindingText(finding);
  }
  if (log.findings.empty()) text += NothingFound(log);
  return text;
}

json HeldOutJson(const InspectionFinding& finding) {
  if (finding.held_out_before == 0) return nullptr;
  return {{"before", JsonNumber(finding.held_out_before)},
          {"after", JsonNumber(finding.held_out_after)}};
}

// Null where nothing is told.
json ClockJson(const SampleClock& clock) {
  if (clock.period == 0) return nullptr;
  return {{"period", JsonNumber(clock.period)},
          {"period_stddev", JsonNumber(clock.period_stddev)},
          {"rate", JsonNumber(clock.rate)},
          {"wander", JsonNumber(clock.wander)},
          {"correlation", JsonNumber(clock.correlation)},
          {"repeated", clock.repeated},
          {"skipped", clock.skipped}};
}

json FindingsJson(const Robot& robot,
                  const std::vector<InspectionFinding>& findings) {
  json list = json::array();
  for (const InspectionFinding& finding : findings) {
    const auto name = [&](int j) {
      return j < 0 ? "" : robot.links[j].joint.name;
    };
    json alternatives = json::array();
    for (const auto& [other, joint] : finding.alternatives) {
      alternatives.push_back({{"finding", other},
                              {"joint", name(joint)},
                              {"joint_index", joint + 1}});
    }
    list.push_back({{"finding", finding.finding},
                    {"sentence", finding.sentence},
                    {"evidence", finding.evidence},
                    {"flag", finding.remedy},
                    {"joint", name(finding.joint)},
                    {"joint_index", finding.joint + 1},
                    {"probability", JsonNumber(finding.probability)},
                    {"held_out", HeldOutJson(finding)},
                    {"alternatives", std::move(alternatives)}});
  }
  return list;
}

// Null where nothing is told.
json ScaleJson(const TorqueScales& scales, int j) {
  if (!scales.told(j)) return nullptr;
  return {{"value", JsonNumber(scales.scale[j])},
          {"low", JsonNumber(scales.low[j])},
          {"high", JsonNumber(scales.high[j])}};
}

json JointsJson(const Robot& robot, const LogInspection& log) {
  json joints = json::array();
  for (int j = 0; j < log.top_speed.size(); ++j) {
    joints.push_back({{"name", robot.links[j].joint.name},
                      {"travel", JsonNumber(log.travel[j])},
                      {"top_speed", JsonNumber(log.top_speed[j])},
                      {"torque_scale", ScaleJson(log.torque_scales, j)}});
    if (log.tracking_rms.size() == 0) continue;
    joints.back()["tracking_rms"] = JsonNumber(log.tracking_rms[j]);
  }
  return joints;
}

}  // namespace

std::string FullReport(const Robot& robot,
                       const std::vector<InspectionFinding>& of_robot,
                       const std::vector<LogInspection>& logs) {
  std::string text =
      Format("%s: %d joint%s\n", robot.name.c_str(), robot.num_joints(),
             robot.num_joints() == 1 ? "" : "s");
  // With logs the report is theirs.
  if (logs.empty()) text += DescriptionText(robot);
  for (const InspectionFinding& finding : of_robot) {
    text += FindingText(finding);
  }
  if (of_robot.empty()) text += "  nothing wrong was found\n";
  for (const std::string& note : RobotNotes(robot)) {
    text += "  note: " + note + "\n";
  }
  for (const LogInspection& log : logs) text += "\n" + LogText(robot, log);
  return text;
}

json ToJson(const Robot& robot, const std::vector<InspectionFinding>& of_robot,
            const std::vector<LogInspection>& logs) {
  json list = json::array();
  for (const LogInspection& log : logs) {
    list.push_back({{"file", log.path},
                    {"rows", log.rows},
                    {"whole", log.whole},
                    {"duration", JsonNumber(log.duration)},
                    {"step", JsonNumber(log.stamps.mean_step)},
                    {"longest_step", JsonNumber(log.stamps.longest_gap)},
                    {"lost_share", JsonNumber(log.stamps.lost_share)},
                    {"duplicates", log.stamps.duplicates},
                    {"clock", ClockJson(log.clock)},
                    {"moving_share", JsonNumber(log.moving_share)},
                    {"spelling", log.spelling},
                    {"torque", log.torque_source},
                    {"residual_percent", JsonNumber(log.residual_percent)},
                    {"explains_torque", log.ExplainsTorque()},
                    {"joints", JointsJson(robot, log)},
                    {"coverage", CoverageJson(robot, log.coverage)},
                    {"findings", FindingsJson(robot, log.findings)}});
  }
  json of_file = DescriptionJson(robot);
  of_file["findings"] = FindingsJson(robot, of_robot);
  for (const std::string& note : RobotNotes(robot)) {
    of_file["notes"].push_back(note);
  }
  return {{"robot", of_file}, {"logs", list}};
}

}  // namespace armcal
