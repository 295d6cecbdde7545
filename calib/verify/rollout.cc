#include "calib/verify/rollout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calib/verify/simbody_rollouts.h"
#include "model/dynamics/batch_torque_replay.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

constexpr double kNeverLost = std::numeric_limits<double>::infinity();

// rms over the rows after `first` of simulated minus recorded, per joint.
Eigen::RowVectorXd RmsFrom(const MatrixXd& simulated, const MatrixXd& recorded,
                           int first) {
  const auto length = simulated.rows();
  return (simulated - recorded.middleRows(first + 1, length)).colwise().norm() /
         std::sqrt(static_cast<double>(length));
}

class Roller {
 public:
  Roller(const std::vector<RolloutModel>& models, const RolloutOptions& options,
         const std::vector<TimeBase>& time_bases)
      : models_(models), options_(options), time_bases_(time_bases) {
    for (const double window_s : options.windows_s) {
      rollouts_.push_back({window_s, {}});
    }
    for (const RolloutModel& model : models) {
      replays_.emplace_back(model.robot, model.transitions);
    }
    coulomb_.resize(models.size());
    double samples = 0;
    for (const TimeBase& base : time_bases) samples += base.samples;
    if (options.simbody_s) simbody_.emplace(models, options, samples);
  }

  // Multiple shooting: each window begins at the log's own state. Over a whole
  // log errors would grow with the loop open until they say nothing of the
  // model.
  void Add(int log, const Trajectory& trajectory) {
    tasks_.clear();
    targets_.clear();
    for (size_t r = 0; r < rollouts_.size(); ++r) {
      AddWindows(log, trajectory, static_cast<int>(r));
    }
    for (size_t m = 0; m < models_.size(); ++m) {
      SimulateOurselves(trajectory, static_cast<int>(m));
    }
    if (simbody_) AskSimbody(log, trajectory);
  }

  std::vector<Rollouts> TakeRollouts() { return std::move(rollouts_); }

 private:
  // Where a task's result belongs.
  struct Target {
    int rollouts;  // of which length
    int index;     // among the stretch's windows of this length
    int window;    // in Rollouts::windows
  };

  RolloutWindow& WindowOf(const Target& target) {
    return rollouts_[target.rollouts].windows[target.window];
  }

  static int Length(const Rollouts& rollouts, const Trajectory& trajectory) {
    return std::max(
        1, static_cast<int>(std::lround(rollouts.window_s / trajectory.dt)));
  }

  static std::vector<int> Begins(const Trajectory& trajectory,
                                 Rollouts* rollouts) {
    const int length = Length(*rollouts, trajectory);
    std::vector<int> begins;
    for (int k = trajectory.core_begin; k < trajectory.core_end; ++k) {
      if ((trajectory.first_index + k) % length != 0) continue;
      if (k + length >= trajectory.size()) continue;
      if (2 * trajectory.standstill.segment(k, length + 1).count() > length) {
        ++rollouts->standstill;
        continue;
      }
      begins.push_back(k);
    }
    return begins;
  }

  void AddWindows(int log, const Trajectory& trajectory, int r) {
    Rollouts& rollouts = rollouts_[r];
    const MatrixXd unknown =
        MatrixXd::Constant(models_.size(), trajectory.num_joints(), kNeverLost);
    int index = 0;
    for (const int k : Begins(trajectory, &rollouts)) {
      targets_.push_back(
          {r, index++, static_cast<int>(rollouts.windows.size())});
      rollouts.windows.push_back(
          {log, trajectory.time(k), unknown, unknown, unknown, {}});
      WindowTask task{k, Length(rollouts, trajectory), {}, {}};
      task.coulomb.resize(models_.size());
      task.own_q.resize(models_.size());
      tasks_.push_back(std::move(task));
    }
  }

  // Simulates model m over the stretch's windows, those of one length in lanes.
  void SimulateOurselves(const Trajectory& trajectory, int m) {
    const MatrixXd& coulomb = replays_[m].Follow(trajectory);
    coulomb_[m] = &coulomb;
    for (size_t begin = 0, end = 0; begin < tasks_.size(); begin = end) {
      std::vector<int> first;
      for (; end < tasks_.size() && tasks_[end].length == tasks_[begin].length;
           ++end) {
        first.push_back(tasks_[end].first);
      }
      const std::vector<ReplayedWindow> replayed = replays_[m].Run(
          trajectory, first, tasks_[begin].length, coulomb, options_.tolerance);
      for (size_t k = begin; k < end; ++k) {
        Keep(trajectory, m, coulomb, replayed[k - begin], static_cast<int>(k));
      }
    }
  }

  void Keep(const Trajectory& trajectory, int m, const MatrixXd& coulomb,
            const ReplayedWindow& replayed, int k) {
    WindowTask& task = tasks_[k];
    task.coulomb[m] = coulomb.row(task.first);
    if (!replayed.finished) return;
    RolloutWindow& window = WindowOf(targets_[k]);
    window.q.row(m) = RmsFrom(replayed.q, trajectory.q, task.first);
    window.qd.row(m) = RmsFrom(replayed.qd, trajectory.qd, task.first);
    window.own_q.row(m) = window.q.row(m);
    if (simbody_) task.own_q[m] = replayed.q;
  }

  // Where Simbody simulates a window as well, its result counts.
  void AskSimbody(int log, const Trajectory& trajectory) {
    std::vector<int> indices;
    for (const Target& target : targets_) indices.push_back(target.index);
    const double samples = (trajectory.core_end - trajectory.core_begin) *
                           trajectory.dt / time_bases_[log].dt;
    const std::vector<SimbodyAnswer> answers = simbody_->Run(
        trajectory, samples, tasks_, SpreadOrder(indices),
        log == last_log_ ? 0 : static_cast<int>(rollouts_.size()));
    last_log_ = log;
    for (size_t k = 0; k < answers.size(); ++k) {
      for (size_t m = 0; m < answers[k].states.size(); ++m) {
        Take(trajectory, answers[k], static_cast<int>(k), static_cast<int>(m));
      }
    }
  }

  // Simbody's answer of model m over window k of the stretch.
  void Take(const Trajectory& trajectory, const SimbodyAnswer& answer, int k,
            int m) {
    using State = SimbodyAnswer::State;
    Rollouts& rollouts = rollouts_[targets_[k].rollouts];
    if (answer.states[m] == State::kNotAsked) return;
    if (answer.states[m] == State::kUnfinished) {
      ++rollouts.unfinished_in_simbody;
      return;
    }
    RolloutWindow& window = WindowOf(targets_[k]);
    window.simbody.push_back(m);
    ++rollouts.in_simbody;
    Compare(trajectory, answer, k, m);
    if (answer.states[m] == State::kLost) {
      window.q.row(m).setConstant(kNeverLost);
      window.qd.row(m).setConstant(kNeverLost);
      return;
    }
    const int first = tasks_[k].first;
    window.q.row(m) = RmsFrom(answer.simulated[m].q, trajectory.q, first);
    window.qd.row(m) = RmsFrom(answer.simulated[m].qd, trajectory.qd, first);
  }

  // How far Simbody's positions are from ours; infinitely where it is lost and
  // ours are not. Unstable motion makes the errors of ours grow too: where they
  // differ ours are computed again, a thousand times as exactly, so that what
  // is left is a difference of the models; where that takes too small a step,
  // nothing can be said of this window.
  void Compare(const Trajectory& trajectory, const SimbodyAnswer& answer, int k,
               int m) {
    const WindowTask& task = tasks_[k];
    if (task.own_q[m].size() == 0) return;
    const bool lost = answer.states[m] == SimbodyAnswer::State::kLost;
    const auto from = [&](const MatrixXd& own) {
      return lost ? kNeverLost
                  : (answer.simulated[m].q - own).cwiseAbs().maxCoeff();
    };
    double difference = from(task.own_q[m]);
    if (difference > options_.tolerance) {
      const ReplayedWindow finer =
          replays_[m].Run(trajectory, {task.first}, task.length, *coulomb_[m],
                          options_.tolerance / 1000)[0];
      if (!finer.finished) return;
      difference = from(finer.q);
    }
    Rollouts& rollouts = rollouts_[targets_[k].rollouts];
    ++rollouts.compared;
    rollouts.simbody_difference =
        std::max(rollouts.simbody_difference, difference);
  }

  const std::vector<RolloutModel>& models_;
  const RolloutOptions& options_;
  const std::vector<TimeBase>& time_bases_;
  std::vector<BatchTorqueReplay> replays_;
  std::vector<const MatrixXd*> coulomb_;  // of the stretch, per model
  std::optional<SimbodyRollouts> simbody_;
  std::vector<Rollouts> rollouts_;
  std::vector<WindowTask> tasks_;  // of the stretch, lengths in turn
  std::vector<Target> targets_;    // of these
  int last_log_ = -1;              // that Simbody was asked of
};

double RmsOver(const Eigen::RowVectorXd& rms, const std::vector<int>& joints) {
  double sum = 0;
  for (const int j : joints) sum += rms[j] * rms[j];
  return std::sqrt(sum / static_cast<double>(joints.size()));
}

}  // namespace

bool RolloutWindow::diverged(int model) const {
  return !q.row(model).allFinite();
}

bool RolloutWindow::in_simbody(int model) const {
  return std::find(simbody.begin(), simbody.end(), model) != simbody.end();
}

double RolloutWindow::Error(int model, const std::vector<int>& joints) const {
  return RmsOver(q.row(model), joints);
}

double RolloutWindow::VelocityError(int model,
                                    const std::vector<int>& joints) const {
  return RmsOver(qd.row(model), joints);
}

double RolloutWindow::OwnError(int model,
                               const std::vector<int>& joints) const {
  return RmsOver(own_q.row(model), joints);
}

int Rollouts::NumDiverged(int model) const {
  return static_cast<int>(std::count_if(
      windows.begin(), windows.end(),
      [model](const RolloutWindow& w) { return w.diverged(model); }));
}

PreparationOptions PreparationFor(const RolloutOptions& options,
                                  double bandwidth_hz) {
  PreparationOptions prepared;
  prepared.bandwidth_hz = bandwidth_hz;
  prepared.reach_s =
      *std::max_element(options.windows_s.begin(), options.windows_s.end());
  return prepared;
}

std::vector<Rollouts> RollOut(const std::vector<RolloutModel>& models,
                              const RolloutOptions& options,
                              double bandwidth_hz, const LogSet& logs) {
  const PreparedLogs prepared =
      Prepare(logs, PreparationFor(options, bandwidth_hz));
  Roller roller(models, options, prepared.time_bases());
  prepared.ForEach("rollouts", options.progress,
                   [&roller](int log, const Trajectory& trajectory) {
                     roller.Add(log, trajectory);
                   });
  return roller.TakeRollouts();
}

}  // namespace armcal
