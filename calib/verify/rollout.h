#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "calib/logs/prepared_logs.h"
#include "model/dynamics/batch_torque_replay.h"
#include "model/dynamics/torque_replay.h"

namespace armcal {

struct RolloutOptions {
  std::vector<double> windows_s = {0.2, 0.5, 1};
  // To which windows are simulated, rad (m), and 100 times that in rad/s (m/s).
  double tolerance = 1e-5;
  Progress progress;
};

// A robot that is simulated.
struct RolloutModel {
  BatchTorqueReplay* replay;
  // The same robot in another engine, which simulates a few of the windows too;
  // may be null.
  TorqueReplay* referee = nullptr;
};

// A stretch of a log that every model was simulated over from the log's own
// (low-passed) state with the logged torque. Models in rows, joints in columns;
// rms over the stretch of simulated minus recorded, infinite where the
// simulation did not come to its end.
struct RolloutWindow {
  int log;
  double begin;        // s since the log's first row
  Eigen::MatrixXd q;   // rad or m
  Eigen::MatrixXd qd;  // rad/s or m/s

  bool diverged(int model) const;
  // rms of positions and of velocities over joints of one unit.
  double Error(int model, const std::vector<int>& joints) const;
  double VelocityError(int model, const std::vector<int>& joints) const;
};

// Windows side by side, of one length.
struct Rollouts {
  double window_s;
  std::vector<RolloutWindow> windows;  // in the order of time
  int standstill = 0;                  // windows that stand still, left out
  // How many simulations were done by referees too, and how far from these
  // their positions were at most, rad or m.
  int refereed = 0;
  double referee_difference = 0;

  int NumDiverged(int model) const;
};

// How logs are prepared for them.
PreparationOptions PreparationFor(const RolloutOptions& options,
                                  double bandwidth_hz);

// Simulates every model over the windows of the logs (multiple shooting). A
// window that stands still for half of its samples or more is left out.
std::vector<Rollouts> RollOut(const std::vector<RolloutModel>& models,
                              const RolloutOptions& options,
                              double bandwidth_hz, const LogSet& logs);

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

}  // namespace armcal
