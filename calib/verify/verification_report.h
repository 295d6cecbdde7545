#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/closed_loop/comparison.h"
#include "calib/verify/log_torques.h"
#include "calib/verify/rollout_comparison.h"
#include "calib/verify/verification.h"
#include "model/robot/robot.h"

namespace armcal {

// A verification with what it was asked of.
struct VerificationReport {
  Robot robot;  // that was verified
  Verification verification;
  // Where a log with torques was given.
  std::optional<RolloutComparisons> rollouts;
  std::optional<LogTorques> log_torques;
  // Where a controller was given, a loop that follows the logged command.
  std::optional<ClosedLoopComparison> closed_loop;
  std::uint64_t seed = 1;
  std::string calibration;  // path; empty: the robot file as it is
  bool calibration_converged = true;
  std::vector<std::string> logs;      // replayed
  std::vector<std::string> warnings;  // sentences on what was mended of them
  // Logs that the calibration was fitted to: no held-out check.
  std::vector<std::string> seen_logs;

  // The verification's, and that the calibrated robot's rollouts of 0.5 s are
  // not farther from the log than the file's: the lower end of their ratio's
  // interval is at most 1. One length only, so that a good calibration is
  // refused by chance at most once in 40 for each unit of joints. Not judged
  // with less than ten blocks of windows (rollout_figures.h), nor where the
  // errors are the integration's.
  std::vector<VerificationCheck> Checks() const;
  // Sentences, one for each thing that is wrong.
  std::vector<std::string> Shortcomings() const;
  bool passed() const { return Shortcomings().empty(); }
};

std::string FullReport(const VerificationReport& report);
// verification.json (docs/verify.md).
nlohmann::json ToJson(const VerificationReport& report);

}  // namespace armcal
