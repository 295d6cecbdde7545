#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/logs/prepared_logs.h"
#include "calib/verify/rollout_options.h"

namespace armcal {

// A stretch of a log that every model was simulated over from the log's own
// (low-passed) state with the logged torque. Models in rows, joints in columns;
// rms over the stretch of simulated minus recorded, infinite where the
// simulation did not come to its end. By Simbody's dynamics for the models that
// it simulated over this window, by our own for the others.
struct RolloutWindow {
  int log;
  double begin;              // s since the log's first row
  Eigen::MatrixXd q;         // rad or m
  Eigen::MatrixXd qd;        // rad/s or m/s
  Eigen::MatrixXd own_q;     // by our own dynamics, whatever `q` is by
  std::vector<int> simbody;  // models that Simbody simulated

  bool diverged(int model) const;
  bool in_simbody(int model) const;
  // rms of positions and of velocities over joints of one unit.
  double Error(int model, const std::vector<int>& joints) const;
  double VelocityError(int model, const std::vector<int>& joints) const;
  // Of positions by our own dynamics.
  double OwnError(int model, const std::vector<int>& joints) const;
};

// Windows side by side, of one length.
struct Rollouts {
  double window_s;
  std::vector<RolloutWindow> windows;  // in the order of time
  int standstill = 0;                  // windows that stand still, left out
  // How many simulations Simbody did, and how many it began and could not end
  // in its steps, which are ours.
  int in_simbody = 0;
  int unfinished_in_simbody = 0;
  // How many of its simulations were compared with ours, and how far apart the
  // positions were at most, rad or m. Not compared are those that ours did not
  // end, or not exactly enough.
  int compared = 0;
  double simbody_difference = 0;

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

}  // namespace armcal
