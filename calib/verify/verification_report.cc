#include "calib/verify/verification_report.h"

#include <algorithm>
#include <cmath>

#include "model/text/format.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

// Between our simulation of a window and Simbody's, rad or m: ten times what
// ours is made to (RolloutOptions::tolerance).
constexpr double kSameRollout = 1e-4;

// What a check is called on a terminal.
std::string CheckTitle(const std::string& name) {
  if (name == "torque_max_rel") return "torque";
  if (name == "mass_matrix_max_rel") return "mass matrix";
  if (name == "gravity_max_rel") return "gravity torque";
  if (name == "energy_max_rel") return "energy";
  if (name == "energy_drift_rel") return "energy drift, Simbody";
  if (name == "own_energy_drift_rel") return "energy drift, ours";
  if (name == "own_consistency_rel") return "forward, then inverse";
  if (name == "log_torque_max_rel") return "torque along the logs";
  return name;
}

// The torque along the logs is compared where there is a sample and Simbody
// takes the robot.
VerificationCheck LogTorqueCheck(const LogTorques& torques) {
  return {"log_torque_max_rel", torques.max_rel, LogTorques::kMostRel, true};
}

std::string CheckTable(const VerificationReport& report) {
  std::string text =
      "\nours against Simbody      largest relative difference   at most\n";
  std::vector<VerificationCheck> checks = report.verification.Checks();
  if (report.log_torques) checks.push_back(LogTorqueCheck(*report.log_torques));
  for (const VerificationCheck& check : checks) {
    const std::string value =
        std::isnan(check.value) ? "not compared" : Format("%.2e", check.value);
    text += Format("  %-24s %26s %9.0e%s\n", CheckTitle(check.name).c_str(),
                   value.c_str(), check.threshold,
                   check.passed() ? "" : "   missed");
  }
  return text;
}

std::string NumberOrDash(double x) {
  return std::isfinite(x) ? Format("%.3g", x) : std::string("-");
}

std::string FigureText(const RolloutFigure& figure) {
  if (figure.windows == 0) return "no window";
  if (!std::isfinite(figure.value)) return "diverges";
  std::string text = Format("%.3g", figure.value);
  if (std::isnan(figure.low)) return text;
  return text + (std::isfinite(figure.high)
                     ? Format(" [%.3g %.3g]", figure.low, figure.high)
                     : Format(" [%.3g -]", figure.low));
}

std::string RolloutRow(const RolloutComparison& c) {
  std::string row =
      Format("  %4g s %4s %8d   %-30s", c.window_s, c.unit.c_str(), c.windows,
             FigureText(c.before).c_str());
  if (c.after) {
    row += Format(" %-30s %s", FigureText(*c.after).c_str(),
                  FigureText(*c.ratio).c_str());
  }
  row.erase(row.find_last_not_of(' ') + 1);
  row += "\n";
  if (c.before_diverged + c.after_diverged > 0) {
    row += Format("         windows whose simulation ended early: %d before",
                  c.before_diverged);
    row += c.after ? Format(", %d after\n", c.after_diverged) : "\n";
  }
  return row;
}

// Says what the rollouts that are judged do not show: an interval of the ratio
// that holds 1 does not show that the calibrated robot is better.
std::string JudgementText(const RolloutComparison& c) {
  if (c.window_s != kJudgedWindow || !c.ratio || c.windows == 0) return "";
  const std::string joints = "  joints in " + c.unit + ": ";
  if (!c.ratio->can_judge()) {
    return joints + "too few windows to judge\n" +
           Format(
               "         (%d of %g s, correlated over blocks of %d; ten "
               "blocks are needed)\n",
               c.windows, c.window_s, c.ratio->block);
  }
  if (!c.is_judged()) return joints + "no error above the integration's\n";
  if (c.ratio->low > 1) return joints + "worse than the file\n";
  return c.ratio->high < 1 ? ""
                           : joints + "not shown to be better than the file\n";
}

// By whose dynamics the windows were simulated.
std::string EnginesText(const RolloutComparisons& rollouts) {
  if (rollouts.in_simbody == 0) return "by armcal";
  if (rollouts.in_simbody == rollouts.simulations) return "by Simbody";
  return Format("%d of %d times by Simbody, else by armcal",
                rollouts.in_simbody, rollouts.simulations);
}

// Where the rows mix engines, what each says of the same windows; and how near
// they are to each other.
std::string BothEnginesText(const RolloutComparisons& rollouts) {
  if (rollouts.in_simbody == 0) return "";
  std::string text;
  for (const RolloutComparison& c : rollouts.windows) {
    const EngineErrors& errors =
        c.after_by_engine ? *c.after_by_engine : c.before_by_engine;
    if (c.window_s != kJudgedWindow || errors.windows == c.windows ||
        errors.windows == 0) {
      continue;
    }
    text += Format(
        "  of %g s in %s, %d windows: %.3g by Simbody, %.3g by armcal\n",
        c.window_s, c.unit.c_str(), errors.windows, errors.simbody, errors.own);
  }
  if (rollouts.compared == 0) return text;
  return text + Format(
                    "  positions by Simbody and by armcal: within %.2g rad "
                    "or m in %d simulations\n",
                    rollouts.simbody_difference, rollouts.compared);
}

// A row per length and unit, what the judged ones do not show, and what was
// left out.
std::string RolloutTable(const RolloutComparisons& rollouts) {
  if (rollouts.windows.empty()) return "";
  const bool calibrated = rollouts.windows[0].after.has_value();
  std::string text = "\nsimulated from the log's states with its torque, " +
                     EnginesText(rollouts) +
                     "\nrms of positions, median over windows [95 %]\n"
                     "  window     windows     the file's robot";
  text += calibrated ? "               calibrated                     ratio\n"
                     : "\n";
  for (const RolloutComparison& c : rollouts.windows) text += RolloutRow(c);
  for (const RolloutComparison& c : rollouts.windows) text += JudgementText(c);
  const RolloutComparison& first = rollouts.windows[0];
  if (first.standstill > 0) {
    text += Format("  standstill left out: %d windows of %g s\n",
                   first.standstill, first.window_s);
  }
  if (!rollouts.before_in_simbody || !rollouts.after_in_simbody) {
    text += std::string("  not simulated in Simbody, which refuses ") +
            (rollouts.after_in_simbody ? "the file's robot\n" : "links\n");
  }
  if (rollouts.unfinished_in_simbody > 0) {
    text += Format("  %d took Simbody too many steps: armcal's\n",
                   rollouts.unfinished_in_simbody);
  }
  return text + BothEnginesText(rollouts);
}

// Recorded torque minus the robots', joint by joint.
std::string LogTorqueTable(const LogTorques& torques) {
  const bool refused = std::all_of(torques.joints.begin(), torques.joints.end(),
                                   [](const JointLogTorque& joint) {
                                     return std::isnan(joint.before_rms) &&
                                            std::isnan(joint.after_rms);
                                   });
  if (refused) return "";  // by Simbody, or there is no sample
  std::string text = Format(
      "\nrecorded torque minus that of Simbody's inverse dynamics; rms of %d "
      "samples\n"
      "  joint                      the file's robot  calibrated  recorded\n",
      torques.samples);
  for (const JointLogTorque& joint : torques.joints) {
    text += Format("  %-20s %-3s %18s %11s %9s\n", joint.name.c_str(),
                   joint.unit.c_str(), NumberOrDash(joint.before_rms).c_str(),
                   NumberOrDash(joint.after_rms).c_str(),
                   NumberOrDash(joint.recorded_rms).c_str());
  }
  return text;
}

std::string ClosedLoopTable(const ClosedLoopComparison& loop) {
  std::string text =
      "\nclosed loop along the logged command; rms of simulated minus "
      "recorded\n"
      "  joint              position: file  calibrated       torque: file  "
      "calibrated  recorded\n";
  for (const ClosedLoopJoint& joint : loop.joints) {
    text += Format("  %-20s %12s %11s %-4s %13s %11s %9s\n", joint.name.c_str(),
                   NumberOrDash(joint.before_rms).c_str(),
                   NumberOrDash(joint.after_rms).c_str(), joint.unit.c_str(),
                   NumberOrDash(joint.before_torque_rms).c_str(),
                   NumberOrDash(joint.after_torque_rms).c_str(),
                   NumberOrDash(joint.torque_rms).c_str());
  }
  return text;
}

// What kept a swing from being followed to its end is no fault of the robot's.
std::string SwingNote(const Verification& v) {
  if (v.swing_s == 0) return "";
  if (std::isnan(v.energy_drift_rel) && v.reasons.empty()) {
    return "note       Simbody's integrator does not follow a passive swing: "
           "its drift is not compared\n";
  }
  if (v.swing_s == VerificationOptions().swing_s) return "";
  return "note       the passive swing takes " + NumberText(v.swing_s) +
         " s: integrators do not follow a longer one\n";
}

// What was verified, on what.
std::string Heading(const VerificationReport& report) {
  const Verification& v = report.verification;
  std::string text =
      "robot      " + report.robot.name + ", " +
      std::to_string(report.robot.num_joints()) + " joints" +
      (report.calibration.empty() ? std::string(", as its file has it")
                                  : ", as " + report.calibration + " has it") +
      "\n";
  for (const std::string& log : report.logs) text += "log        " + log + "\n";
  for (const std::string& log : report.seen_logs) {
    text += "note       the calibration was fitted to " + log +
            ": rollouts over it are no check on unseen data\n";
  }
  if (!report.calibration_converged) {
    text +=
        "note       the calibration did not converge: its parameters are "
        "those of its last step\n";
  }
  text += "states     " + std::to_string(v.random_states) + " random ones, " +
          std::to_string(v.log_states) + " of the logs\n";
  return text + SwingNote(v);
}

}  // namespace

std::vector<VerificationCheck> VerificationReport::Checks() const {
  std::vector<VerificationCheck> checks = verification.Checks();
  if (log_torques) checks.push_back(LogTorqueCheck(*log_torques));
  if (!rollouts) return checks;
  for (const RolloutComparison& c : rollouts->windows) {
    if (!c.is_judged()) continue;
    checks.push_back(
        {"rollout_ratio_low_" + NumberText(c.window_s) + "s_" + c.unit,
         c.ratio->low, 1});
  }
  if (rollouts->compared > 0) {
    checks.push_back(
        {"rollout_max_abs", rollouts->simbody_difference, kSameRollout});
  }
  return checks;
}

// A sentence for each check that was missed, and for what could not be compared
// unless a reason has said so already.
std::vector<std::string> VerificationReport::Shortcomings() const {
  std::vector<std::string> list = verification.reasons;
  if (closed_loop && !closed_loop->after_finite) {
    list.push_back(robot.name + ": its closed loop is not stable");
  }
  for (const VerificationCheck& check : Checks()) {
    // Why nothing could be compared is one of the reasons.
    const bool told = std::isnan(check.value) && !verification.reasons.empty();
    if (check.passed() || told) continue;
    list.push_back(robot.name + ": " + check.name + " is " +
                   (std::isnan(check.value) ? std::string("unknown")
                                            : NumberText(check.value)) +
                   ", expected at most " + NumberText(check.threshold));
  }
  return list;
}

std::string FullReport(const VerificationReport& report) {
  std::string text;
  for (const std::string& warning : report.warnings) {
    text += "warning    " + warning + "\n";
  }
  text += Heading(report) + CheckTable(report);
  if (report.rollouts) text += RolloutTable(*report.rollouts);
  if (report.log_torques) text += LogTorqueTable(*report.log_torques);
  if (report.closed_loop) text += ClosedLoopTable(*report.closed_loop);
  text += "\n";
  const std::vector<std::string> shortcomings = report.Shortcomings();
  for (const std::string& reason : shortcomings) {
    text += "not verified: " + reason + "\n";
  }
  if (shortcomings.empty()) text += report.robot.name + ": verified\n";
  return text;
}

}  // namespace armcal
