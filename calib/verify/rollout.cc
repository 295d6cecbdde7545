#include "calib/verify/rollout.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "calib/numerics/block_bootstrap.h"
#include "calib/numerics/undefined.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNeverLost = std::numeric_limits<double>::infinity();

// How many simulations referees repeat, of each length, model and stretch of a
// log.
constexpr int kRefereed = 1;
// A referee's local error, and how many steps it may take for it. Unstable
// motion makes errors grow a thousandfold within a second: where a referee
// disagrees it is asked again, more exactly.
struct RefereeEffort {
  double tolerance;
  long steps;
};
constexpr RefereeEffort kRefereeEfforts[] = {{1e-8, 1500}, {1e-11, 15'000}};

class Roller {
 public:
  Roller(const std::vector<RolloutModel>& models, const RolloutOptions& options)
      : models_(models), options_(options) {
    for (const double window_s : options.windows_s) {
      rollouts_.push_back({window_s, {}, 0});
    }
  }

  // Multiple shooting: each window begins at the log's own state. Over a whole
  // log errors would grow with the loop open until they say nothing of the
  // model.
  void Add(int log, const Trajectory& trajectory) {
    std::vector<std::vector<int>> begins;  // of windows, per length
    for (Rollouts& rollouts : rollouts_) {
      begins.push_back(Begins(trajectory, &rollouts));
      for (const int k : begins.back()) {
        const MatrixXd unknown = MatrixXd::Constant(
            models_.size(), trajectory.num_joints(), kNeverLost);
        rollouts.windows.push_back({log, trajectory.time(k), unknown, unknown});
      }
    }
    for (size_t m = 0; m < models_.size(); ++m) {
      const MatrixXd& coulomb = models_[m].replay->Follow(trajectory);
      for (size_t r = 0; r < rollouts_.size(); ++r) {
        Simulate(trajectory, begins[r], static_cast<int>(m), coulomb,
                 &rollouts_[r]);
      }
    }
  }

  std::vector<Rollouts> TakeRollouts() { return std::move(rollouts_); }

 private:
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

  // Simulates model m over the last windows of the rollouts.
  void Simulate(const Trajectory& trajectory, const std::vector<int>& begins,
                int m, const MatrixXd& coulomb, Rollouts* rollouts) {
    const int length = Length(*rollouts, trajectory);
    const std::vector<ReplayedWindow> replayed = models_[m].replay->Run(
        trajectory, begins, length, coulomb, options_.tolerance);
    int refereed = 0;
    for (size_t w = 0; w < begins.size(); ++w) {
      if (!replayed[w].finished) continue;
      const auto rms = [&](const MatrixXd& x, const MatrixXd& recorded) {
        return ((x - recorded.middleRows(begins[w] + 1, length))
                    .colwise()
                    .norm() /
                std::sqrt(length))
            .eval();
      };
      RolloutWindow& window =
          rollouts->windows[rollouts->windows.size() - begins.size() + w];
      window.q.row(m) = rms(replayed[w].q, trajectory.q);
      window.qd.row(m) = rms(replayed[w].qd, trajectory.qd);
      if (refereed++ < kRefereed && models_[m].referee != nullptr) {
        Referee(trajectory, begins[w], coulomb.row(begins[w]), replayed[w].q,
                models_[m].referee, rollouts);
      }
    }
  }

  // Repeats a window in the other engine and with another integrator. Where
  // they differ, it is asked again more exactly, so that what is left is not
  // its own error.
  void Referee(const Trajectory& trajectory, int begin, const VectorXd& coulomb,
               const MatrixXd& q, TorqueReplay* referee,
               Rollouts* rollouts) const {
    double difference = kNaN;
    for (const RefereeEffort& effort : kRefereeEfforts) {
      IntegrationOptions options;
      options.relative = options.absolute = effort.tolerance;
      options.max_steps = effort.steps;
      const Integration run =
          referee->Run(trajectory, begin, begin + static_cast<int>(q.rows()),
                       coulomb, options);
      if (!run.finished) return;
      difference = (run.x.leftCols(q.cols()) - q).cwiseAbs().maxCoeff();
      if (difference <= options_.tolerance) break;
    }
    ++rollouts->refereed;
    rollouts->referee_difference =
        std::max(rollouts->referee_difference, difference);
  }

  const std::vector<RolloutModel>& models_;
  const RolloutOptions& options_;
  std::vector<Rollouts> rollouts_;
};

double InterpolatedMedian(std::vector<double> values) {
  if (values.empty()) return kNaN;
  const size_t half = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + half, values.end());
  if (values.size() % 2 == 1) return values[half];
  const double below = *std::max_element(values.begin(), values.begin() + half);
  return (below + values[half]) / 2;
}

// `statistic` of all windows, with an interval by a block bootstrap (Kuensch
// 1989, Annals of Statistics 17): blocks as long as windows stay correlated are
// drawn whole.
RolloutFigure WithInterval(
    int windows, double correlation_time, std::uint64_t seed,
    const std::function<double(const std::vector<int>&)>& statistic) {
  std::vector<int> all(windows);
  std::iota(all.begin(), all.end(), 0);
  RolloutFigure figure{statistic(all), kNaN, kNaN, windows};
  if (windows < 2) return figure;
  figure.block = BootstrapBlock(windows, correlation_time);
  const BootstrapInterval interval =
      BlockBootstrap(windows, figure.block, seed, statistic);
  figure.low = interval.low;
  figure.high = interval.high;
  return figure;
}

double RmsOver(const Eigen::RowVectorXd& rms, const std::vector<int>& joints) {
  double sum = 0;
  for (const int j : joints) sum += rms[j] * rms[j];
  return std::sqrt(sum / static_cast<double>(joints.size()));
}

std::vector<double> Errors(const Rollouts& rollouts, int model,
                           const std::vector<int>& joints) {
  std::vector<double> errors;
  for (const RolloutWindow& window : rollouts.windows) {
    errors.push_back(window.Error(model, joints));
  }
  return errors;
}

double MedianOf(const std::vector<double>& errors,
                const std::vector<int>& chosen) {
  std::vector<double> values;
  for (const int k : chosen) values.push_back(errors[k]);
  return InterpolatedMedian(std::move(values));
}

}  // namespace

bool RolloutWindow::diverged(int model) const {
  return !q.row(model).allFinite();
}

double RolloutWindow::Error(int model, const std::vector<int>& joints) const {
  return RmsOver(q.row(model), joints);
}

double RolloutWindow::VelocityError(int model,
                                    const std::vector<int>& joints) const {
  return RmsOver(qd.row(model), joints);
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
  Roller roller(models, options);
  Prepare(logs, PreparationFor(options, bandwidth_hz))
      .ForEach("rollouts", options.progress,
               [&roller](int log, const Trajectory& trajectory) {
                 roller.Add(log, trajectory);
               });
  return roller.TakeRollouts();
}

std::vector<int> JointsWithUnit(const Robot& robot, const std::string& unit) {
  std::vector<int> joints;
  for (int j = 0; j < robot.num_joints(); ++j) {
    if (PositionUnit(robot.links[j].joint.type) == unit) joints.push_back(j);
  }
  return joints;
}

RolloutFigure MedianError(const Rollouts& rollouts, int model,
                          const std::vector<int>& joints, std::uint64_t seed) {
  const std::vector<double> errors = Errors(rollouts, model, joints);
  return WithInterval(static_cast<int>(errors.size()), CorrelationTime(errors),
                      seed, [&errors](const std::vector<int>& chosen) {
                        return MedianOf(errors, chosen);
                      });
}

double MedianVelocityError(const Rollouts& rollouts, int model,
                           const std::vector<int>& joints) {
  std::vector<double> errors;
  for (const RolloutWindow& window : rollouts.windows) {
    errors.push_back(window.VelocityError(model, joints));
  }
  return InterpolatedMedian(std::move(errors));
}

// Both medians are of the same drawn windows. Blocks are as long as the worst
// of both errors and of their ratio stays correlated.
RolloutFigure MedianRatio(const Rollouts& rollouts, int a, int b,
                          const std::vector<int>& joints, std::uint64_t seed) {
  const std::vector<double> of_a = Errors(rollouts, a, joints);
  const std::vector<double> of_b = Errors(rollouts, b, joints);
  std::vector<double> ratios;
  for (size_t k = 0; k < of_a.size(); ++k) {
    const double ratio = of_a[k] / of_b[k];
    ratios.push_back(std::isnan(ratio) ? 1 : ratio);  // both diverge
  }
  const double time = std::max(
      {CorrelationTime(of_a), CorrelationTime(of_b), CorrelationTime(ratios)});
  return WithInterval(static_cast<int>(of_a.size()), time, seed,
                      [&](const std::vector<int>& chosen) {
                        return MedianOf(of_a, chosen) / MedianOf(of_b, chosen);
                      });
}

}  // namespace armcal
