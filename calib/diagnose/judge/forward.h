#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "calib/closed_loop/replay.h"
#include "calib/diagnose/candidates/corrected_robot.h"
#include "calib/diagnose/data/segment.h"
#include "calib/diagnose/judge/removed_share.h"
#include "calib/diagnose/judge/window_replay.h"

namespace armcal {

// Which times of a log, s since its first row, count. Empty: all. Simulations
// run through the others as well.
using CountedTimes = std::function<bool(int log, double t)>;
// Those of which a joint has rows: of a fold (LogPart) what it holds.
CountedTimes TimesWithRows(const GapRows& rows);

// The robots of a forward-simulated gap, MakeCorrectedRobot of: the baseline at
// 0; at its refit; at its fit given the effects, with them.
struct ForwardRobots {
  CorrectedRobot nominal, refit, after;
};

// How far simulated positions are from recorded ones that the
// robots were not fitted to. E is the mean over samples and joints of squared
// deviations, each joint's in units of what measurement noise alone would
// leave, so that the floor is 1 and radians and metres can be added.
struct ForwardGap {
  bool closed_loop = true;
  GapFigures figures;     // joints: rms in rad or m
  Eigen::VectorXd floor;  // n, rms, rad or m
  // Simulations of nominal, refit and after that did not stay finite, of loops
  // or windows. Such a loop is infinitely far off; such a window is left out
  // for all three.
  int diverged[3] = {0, 0, 0};
  // Loops or windows that were simulated; where all diverge, or none counts,
  // there are no figures.
  int runs = 0;
  bool has_figures = false;
};

// In closed loop along the logs' commands (whose times count from their first
// row), by a controller that knows the robot
// `known`. The floor is the noise of the recorded positions (position_noise.h);
// what it makes of the motion by way of the controller is not in it.
ForwardGap ForwardGapInLoop(const ForwardRobots& robots, const Robot& known,
                            const ControllerOptions& controller,
                            const std::vector<CommandedLog>& logs,
                            std::uint64_t seed,
                            const CountedTimes& counted = {});

// By multiple shooting over windows of kForwardWindow. The floor is simulated:
// `after` with noise added to starts, torque and positions.
constexpr double kForwardWindow = .5;  // s
ForwardGap ForwardGapInWindows(const ForwardRobots& robots,
                               const std::vector<GapSegment>& segments,
                               const MeasurementNoise& noise,
                               std::uint64_t seed,
                               const CountedTimes& counted = {});

}  // namespace armcal
