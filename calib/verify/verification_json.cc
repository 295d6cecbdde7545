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
        {"simulations", report.rollouts->refereed},
        {"max_difference", report.rollouts->referee_difference}};
  }
  if (report.closed_loop) {
    out["closed_loop"] = ClosedLoopJson(*report.closed_loop);
  }
  return out;
}

}  // namespace armcal
