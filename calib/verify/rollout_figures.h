#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calib/verify/rollout.h"
#include "model/robot/robot.h"

namespace armcal {

// The joints of a robot whose positions have the unit "rad", "m".
std::vector<int> JointsWithUnit(const Robot& robot, const std::string& unit);

// A figure with its interval of 95 % (block_bootstrap.h): windows follow each
// other in time and are not independent. Where there are ten blocks or more it
// holds the truth in 9 of 10 cases (verify_rollout_long_test); with fewer it
// says little.
struct RolloutFigure {
  double value;  // NaN without windows
  double low, high;
  int windows = 0;
  int block = 1;  // windows
  bool can_judge() const { return windows >= 10 * block; }
};
// The median over windows of a model's rms error of these joints.
RolloutFigure MedianError(const Rollouts& rollouts, int model,
                          const std::vector<int>& joints, std::uint64_t seed);
// Of velocities, without an interval, rad/s or m/s.
double MedianVelocityError(const Rollouts& rollouts, int model,
                           const std::vector<int>& joints);
// Median of model `a` over that of model `b`, of the same windows.
RolloutFigure MedianRatio(const Rollouts& rollouts, int a, int b,
                          const std::vector<int>& joints, std::uint64_t seed);

// The same windows by Simbody's dynamics and by ours: medians of rms errors.
struct EngineErrors {
  int windows = 0;      // in which Simbody simulated the robot
  double simbody, own;  // rad or m; NaN without windows
};
EngineErrors MedianErrorsByEngine(const Rollouts& rollouts, int model,
                                  const std::vector<int>& joints);

}  // namespace armcal
