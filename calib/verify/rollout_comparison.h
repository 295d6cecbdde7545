#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calib/logs/log_set.h"
#include "calib/refine/calibration_reader.h"
#include "calib/verify/rollout_figures.h"
#include "model/robot/robot.h"

namespace armcal {

// Medians over windows; rms of simulated minus recorded positions.
struct JointRollout {
  std::string name;
  double before_rms;  // rad or m
  double after_rms;   // NaN without a calibration
};

// The windows that say which robot is nearer to the log, s.
constexpr double kJudgedWindow = 0.5;

// Windows of one length and the joints of one unit, before calibration and
// after. Medians over windows, rms over the joints.
struct RolloutComparison {
  double window_s;
  std::string unit;  // "rad" or "m"
  int windows = 0;
  int standstill = 0;  // left out
  int before_diverged = 0;
  int after_diverged = 0;
  RolloutFigure before;
  std::optional<RolloutFigure> after;
  std::optional<RolloutFigure> ratio;  // after / before
  EngineErrors before_by_engine;
  std::optional<EngineErrors> after_by_engine;
  double before_velocity_rms;  // rad/s or m/s
  double after_velocity_rms;
  std::vector<JointRollout> joints;

  // Whether these windows say it: there are enough of them, and the errors are
  // not the integration's.
  bool is_judged() const;
};

struct RolloutComparisons {
  std::vector<RolloutComparison> windows;
  // Whether Simbody has the robots, too; it refuses some links.
  bool before_in_simbody = true;
  bool after_in_simbody = true;
  // Of a window, a robot each: how many there are, how many Simbody did, how
  // many it began and could not end (those are ours, as all others are), how
  // many of Simbody's were compared with ours, and how far apart the positions
  // were at most, rad or m.
  int simulations = 0;
  int in_simbody = 0;
  int unfinished_in_simbody = 0;
  int compared = 0;
  double simbody_difference = 0;
};

// Rolls the robot file's robot and, unless null, the calibrated one out over
// the logs. The file's Coulomb friction changes sign as the calibration says;
// without one as `CoulombTransition()` does.
RolloutComparisons CompareRollouts(const Robot& file,
                                   const CalibratedRobot* calibrated,
                                   const RolloutOptions& options,
                                   double bandwidth_hz, std::uint64_t seed,
                                   const LogSet& logs);

}  // namespace armcal
