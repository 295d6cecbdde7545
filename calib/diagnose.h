#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/log_input.h"
#include "calib/robot_source.h"
#include "calib/summary.h"
#include "model/log_files/log_reader_options.h"
#include "model/robot/robot.h"
#include "model/text/progress.h"

namespace armcal {

struct DrawnTorques;  // calib/logs/drawn_torques.h
struct GapDiagnosis;  // calib/diagnose/diagnosis.h

struct DiagnoseOptions {
  // Logs of the same robot from before: the model is fitted to them first, and
  // the diagnosis says what has changed since.
  LogInput reference;
  // Path of a calibration.json for the robot, or of its folder: what is still
  // missing in the calibrated robot, whose parameters are known as well as the
  // calibration says. Empty: the robot's own numbers, and trust.
  std::string calibration;
  // Held out, to check what is found; none: parts of the logs are.
  LogInput validation;
  // How the torques of logs are read; joint_names are the robot's.
  LogReaderOptions reading;
  // Relative standard deviation of the robot file's inertial parameters and
  // friction, of those that no calibration tells. Not given: a file is good to
  // .05, and counts for little (.5) beside a reference.
  std::optional<double> trust;
  // Cutoff below which torques are compared, Hz. Not given: 10 times the
  // motion's frequency, 10 to 20 Hz, at most an eighth of the sample rate.
  std::optional<double> bandwidth_hz;
  std::vector<std::string> without;  // names of effects not to be considered
  // Whether what is held out is simulated as well: along its commands with a
  // controller, else over windows of .5 s.
  bool forward = true;
  // Path of the drives' law (docs/simulate.md); also makes the torques of logs
  // that have none. Empty: none.
  std::string controller;
  // Whether four logs or more are also told which parameters changed when.
  bool changes = false;
  std::uint64_t seed = 0;
  std::vector<std::string> exports;  // formats beside URDF: "mjcf", "sdf" ..
  int samples = 0;                   // robots to draw from what is known
  RobotSource source;                // of the robot
  // Laws that simulators lack as sources for their loops: "python", "c".
  std::vector<std::string> modules;
  bool draw_torques = false;  // keeps `torques` of the summary
  bool verbose = false;       // a report with what is not testable, too
  Progress progress;
};

// An effect that was found.
struct DiagnosedEffect {
  std::string name;   // as in docs/effects
  std::string joint;  // empty: all, or the whole robot
  double probability = 0;
  double removed_percent = 0;  // of the held-out gap, by this one
};

struct DiagnoseSummary : Summary {
  std::string verdict;                   // "explained" .. (docs/diagnose.md)
  std::vector<DiagnosedEffect> effects;  // strongest first
  Robot robot;                           // fitted, with what a robot can hold
  // Paths of the calibration's own logs, which were read as well.
  std::vector<std::string> calibration_logs;
  // Of what is held out, where they are drawn; null: not asked for.
  std::shared_ptr<const DrawnTorques> torques;
  std::shared_ptr<const GapDiagnosis> details;
};

// Where the gap between a robot's model and its logs lies, which effect causes
// it and how far it shrinks once that effect is added. Throws InputError and
// OptionError.
DiagnoseSummary Diagnose(const Robot& robot, const LogInput& logs,
                         const DiagnoseOptions& options);

}  // namespace armcal
