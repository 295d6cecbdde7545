#include <cmath>

#include "calib/numerics/json_figures.h"
#include "calib/verify/verification_report.h"

namespace armcal {
namespace {

using nlohmann::json;

json ClosedLoopJson(const ClosedLoopComparison& loop) {
  json joints = json::array();
  for (const ClosedLoopJoint& joint : loop.joints) {
    joints.push_back(
        {{"name", joint.name},
         {"unit", joint.unit},
         {"before_rms", JsonNumber(joint.before_rms)},
         {"after_rms", JsonNumber(joint.after_rms)},
         {"before_torque_rms", JsonNumber(joint.before_torque_rms)},
         {"after_torque_rms", JsonNumber(joint.after_torque_rms)},
         {"torque_rms", JsonNumber(joint.torque_rms)}});
  }
  return {{"before_finite", loop.before_finite},
          {"after_finite", loop.after_finite},
          {"joints", joints}};
}

json FigureJson(const RolloutFigure& figure) {
  return {JsonNumber(figure.low), JsonNumber(figure.high)};
}

// The same windows by Simbody and by ours, medians of rms errors.
json EnginesJson(const RolloutComparison& c) {
  json out = {{"windows", c.before_by_engine.windows},
              {"before_windows", c.before_by_engine.windows},
              {"before_rms", JsonNumber(c.before_by_engine.simbody)},
              {"own_before_rms", JsonNumber(c.before_by_engine.own)}};
  if (c.after_by_engine) {
    out["windows"] = c.after_by_engine->windows;
    out["after_rms"] = JsonNumber(c.after_by_engine->simbody);
    out["own_after_rms"] = JsonNumber(c.after_by_engine->own);
  }
  return out;
}

json LogTorquesJson(const LogTorques& torques) {
  json out = {{"samples", torques.samples}, {"joints", json::array()}};
  for (const JointLogTorque& joint : torques.joints) {
    out["joints"].push_back({{"name", joint.name},
                             {"unit", joint.unit},
                             {"recorded_rms", JsonNumber(joint.recorded_rms)},
                             {"before_rms", JsonNumber(joint.before_rms)},
                             {"after_rms", JsonNumber(joint.after_rms)}});
  }
  return out;
}

json RolloutJson(const RolloutComparison& c) {
  const double none = std::nan("");
  // The interval is that of the last robot, the calibrated one if there is.
  json out = {{"window_s", c.window_s},
              {"unit", c.unit},
              {"before_rms", JsonNumber(c.before.value)},
              {"after_rms", JsonNumber(c.after ? c.after->value : none)},
              {"ci95", FigureJson(c.after ? *c.after : c.before)},
              {"before_ci95", FigureJson(c.before)},
              {"ratio", JsonNumber(c.ratio ? c.ratio->value : none)},
              {"windows", c.windows},
              {"standstill", c.standstill},
              {"before_diverged", c.before_diverged},
              {"after_diverged", c.after_diverged},
              {"before_velocity_rms", JsonNumber(c.before_velocity_rms)},
              {"after_velocity_rms", JsonNumber(c.after_velocity_rms)},
              {"in_simbody", EnginesJson(c)},
              {"joints", json::array()}};
  if (c.ratio) {
    out["ratio_ci95"] = FigureJson(*c.ratio);
    out["block_windows"] = c.ratio->block;
    out["judged"] = c.is_judged();
  }
  for (const JointRollout& joint : c.joints) {
    out["joints"].push_back({{"name", joint.name},
                             {"before_rms", JsonNumber(joint.before_rms)},
                             {"after_rms", JsonNumber(joint.after_rms)}});
  }
  return out;
}

json ChecksJson(const std::vector<VerificationCheck>& checks) {
  json list = json::array();
  for (const VerificationCheck& check : checks) {
    list.push_back(
        {{"name", check.name},
         {"value", JsonNumber(check.value)},
         {"threshold", check.threshold},
         {"passed", check.compared() ? json(check.passed()) : json(nullptr)}});
  }
  return list;
}

}  // namespace

json ToJson(const VerificationReport& report) {
  const Verification& v = report.verification;
  json out = {{"format", "armcal verification 1"},
              {"robot", report.robot.name},
              {"passed", report.passed()},
              {"states", v.random_states + v.log_states},
              {"random_states", v.random_states},
              {"log_states", v.log_states},
              {"seed", report.seed},
              {"swing_s", v.swing_s},
              {"logs", report.logs},
              {"seen_logs", report.seen_logs},
              {"reasons", report.Shortcomings()},
              {"rollout", json::array()},
              {"calibration", nullptr},
              {"checks", ChecksJson(report.Checks())}};
  if (!report.warnings.empty()) out["warnings"] = report.warnings;
  if (!report.calibration.empty()) {
    out["calibration"] = report.calibration;
    out["calibration_converged"] = report.calibration_converged;
  }
  for (const VerificationCheck& check : v.Checks()) {
    out[check.name] = JsonNumber(check.value);
  }
  if (report.rollouts) {
    for (const RolloutComparison& c : report.rollouts->windows) {
      out["rollout"].push_back(RolloutJson(c));
    }
    out["rollout_in_simbody"] = {
        {"simulations", report.rollouts->in_simbody},
        {"of", report.rollouts->simulations},
        {"unfinished", report.rollouts->unfinished_in_simbody},
        {"compared", report.rollouts->compared},
        {"max_difference", JsonNumber(report.rollouts->compared > 0
                                          ? report.rollouts->simbody_difference
                                          : std::nan(""))}};
  }
  if (report.log_torques) {
    out["log_torque_max_rel"] = JsonNumber(report.log_torques->max_rel);
    out["log_torques"] = LogTorquesJson(*report.log_torques);
  }
  if (report.closed_loop) {
    out["closed_loop"] = ClosedLoopJson(*report.closed_loop);
  }
  return out;
}

}  // namespace armcal
