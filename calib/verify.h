#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/log_input.h"
#include "calib/summary.h"
#include "model/log_files/log_reader_options.h"
#include "model/robot/robot.h"
#include "model/text/progress.h"

namespace armcal {

struct DrawnTorques;        // calib/logs/drawn_torques.h
struct VerificationReport;  // calib/verify/verification_report.h

struct VerifyOptions {
  // Path of a calibration.json for the robot, whose refined parameters are
  // verified; empty: the robot's own are.
  std::string calibration;
  // How the torques of logs are read; joint_names are the robot's.
  LogReaderOptions reading;
  // Cutoff of the zero-phase low pass on positions, Hz. Not given: that of the
  // calibration, or 10 times the motion's frequency, 8 to 20 Hz.
  std::optional<double> bandwidth_hz;
  // Path of the drives' law (docs/simulate.md): a loop follows the command of
  // the one log; empty: none does.
  std::string controller;
  // How long Simbody may simulate stretches of the logs, s by the clock: those
  // that it does not reach are simulated by our own dynamics. 0: it simulates
  // all of them.
  double budget_s = 60;
  std::uint64_t seed = 0;     // of random states and of intervals
  bool draw_torques = false;  // keeps `torques` of the summary
  Progress progress;
};

struct VerifySummary : Summary {
  Robot robot;  // that was verified
  // Sentences, one for each thing that is wrong.
  std::vector<std::string> shortcomings;
  // Of the logs, where they are drawn; null: there are none.
  std::shared_ptr<const DrawnTorques> torques;
  std::shared_ptr<const VerificationReport> details;
};

// Checks a robot, or a calibration of it, against Simbody: torques, mass
// matrix, gravity and energy on random states and on those of the logs (none:
// random ones alone), and simulated over stretches of the logs, by Simbody as
// far as its time allows. Throws InputError and OptionError.
VerifySummary Verify(const Robot& robot, const LogInput& logs,
                     const VerifyOptions& options);

}  // namespace armcal
