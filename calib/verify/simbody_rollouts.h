#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "calib/numerics/ordered_work.h"
#include "calib/verify/rollout_options.h"
#include "model/signals/trajectory.h"

namespace armcal {

// A simulation of one window: rows after the window's first, x joints.
struct SimulatedWindow {
  Eigen::MatrixXd q, qd;
};

// A window of a stretch that Simbody may be asked for.
struct WindowTask {
  int first, length;  // rows of the trajectory
  // Per model, the states of Coulomb friction at the first row, and its
  // positions by our own dynamics; empty where these ended early.
  std::vector<Eigen::VectorXd> coulomb;
  std::vector<Eigen::MatrixXd> own_q;
};

// What Simbody answered of a window, per model.
struct SimbodyAnswer {
  enum class State {
    kNotAsked,
    kDone,
    kLost,        // it left the log by 100 rad or 10 m
    kUnfinished,  // it took more steps than it may, or could not go on
  };
  std::vector<State> states;
  std::vector<SimulatedWindow> simulated;  // where it is done
};

// Simulates windows of logs by Simbody's dynamics (TorqueReplay), on all cores,
// until its time is used up: as many as that allows, evenly spread over the
// logs.
class SimbodyRollouts {
 public:
  // `samples`: of all logs, which share options.simbody_s in proportion.
  SimbodyRollouts(const std::vector<RolloutModel>& models,
                  const RolloutOptions& options, double samples);
  ~SimbodyRollouts();

  // Windows of one stretch, of `samples` samples; an answer for each of them.
  // `order`: in which they are asked for; the first `least` are asked for in
  // any case.
  std::vector<SimbodyAnswer> Run(const Trajectory& trajectory, double samples,
                                 const std::vector<WindowTask>& tasks,
                                 const std::vector<int>& order, int least);

 private:
  struct Engine;

  SimbodyAnswer Simulate(const Trajectory& trajectory, const WindowTask& task,
                         std::vector<std::unique_ptr<Engine>>* engines) const;

  const std::vector<RolloutModel>& models_;
  const RolloutOptions& options_;
  OrderedWork work_;
  // Per slot of the work and model, null where Simbody refuses it.
  std::vector<std::vector<std::unique_ptr<Engine>>> engines_;
  double seconds_left_, samples_left_;
};

// An order of tasks in which each beginning is evenly spread over all of them:
// by the digits of their index read backwards (van der Corput 1935), each
// length in proportion to its windows. `indices`: of each task among those of
// its length.
std::vector<int> SpreadOrder(const std::vector<int>& indices);

}  // namespace armcal
