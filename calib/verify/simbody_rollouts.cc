#include "calib/verify/simbody_rollouts.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <numeric>

#include "calib/verify/arm_engine.h"
#include "model/dynamics/torque_replay.h"

namespace armcal {
namespace {

using Clock = std::chrono::steady_clock;

// Simbody's local error, and how many steps it may take for it. Unstable motion
// makes errors grow a thousandfold within a second: where a simulation differs
// from ours it is done again, more exactly. With 4000 steps all windows of the
// calibrated UR10e, Panda, KR300 and LWA 4P come to their end; light wrists
// with dry friction would take ten times that, and all of the time there is.
struct IntegratorLimits {
  double tolerance;
  long steps;
};
constexpr IntegratorLimits kLimits[] = {{1e-8, 4000}, {1e-11, 15'000}};

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::uint32_t ReversedBits(std::uint32_t x) {
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) {
    reversed = (reversed << 1) | ((x >> bit) & 1);
  }
  return reversed;
}

}  // namespace

std::vector<int> SpreadOrder(const std::vector<int>& indices) {
  std::vector<int> order(indices.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&indices](int a, int b) {
    return ReversedBits(indices[a]) < ReversedBits(indices[b]);
  });
  return order;
}

// A robot's links in Simbody, with its joints' friction and armature.
struct SimbodyRollouts::Engine {
  Engine(const RolloutModel& model, std::unique_ptr<ArmDynamics> arm)
      : links(std::move(arm)),
        replay(model.robot, model.transitions, links.get()) {}

  // As TorqueReplay::Run. Simbody throws where a massless tip has driven the
  // state out of what it can compute: then it does not finish.
  Integration Run(const Trajectory& trajectory, int first, int length,
                  const Eigen::VectorXd& coulomb,
                  const IntegrationOptions& options) {
    try {
      return replay.Run(trajectory, first, first + length, coulomb, options);
    } catch (const std::exception& error) {
      Integration failed;
      failed.reason = error.what();
      return failed;
    }
  }

  std::unique_ptr<ArmDynamics> links;
  TorqueReplay replay;
};

SimbodyRollouts::SimbodyRollouts(const std::vector<RolloutModel>& models,
                                 const RolloutOptions& options, double samples)
    : models_(models),
      options_(options),
      engines_(work_.num_slots()),
      seconds_left_(*options.simbody_s),
      samples_left_(samples) {
  for (auto& engines : engines_) {
    for (const RolloutModel& model : models_) {
      ArmEngine engine = MakeArmEngine(model.robot);
      engines.push_back(
          engine.is_simbody
              ? std::make_unique<Engine>(model, std::move(engine.dynamics))
              : nullptr);
    }
  }
}

SimbodyRollouts::~SimbodyRollouts() = default;

// Simulates every model over a window. Where Simbody's positions differ from
// ours by more than ours are made to, they are computed again with a thousandth
// of the local error, so that what is left is not Simbody's integration.
SimbodyAnswer SimbodyRollouts::Simulate(
    const Trajectory& trajectory, const WindowTask& task,
    std::vector<std::unique_ptr<Engine>>* engines) const {
  using State = SimbodyAnswer::State;
  const int n = trajectory.num_joints();
  SimbodyAnswer answer;
  answer.states.resize(models_.size(), State::kNotAsked);
  answer.simulated.resize(models_.size());
  for (size_t m = 0; m < models_.size(); ++m) {
    if ((*engines)[m] == nullptr) continue;
    const bool ended_early = task.own_q[m].size() == 0;
    for (const IntegratorLimits& limits : kLimits) {
      IntegrationOptions options;
      options.relative = options.absolute = limits.tolerance;
      options.max_steps = limits.steps;
      const Integration run = (*engines)[m]->Run(
          trajectory, task.first, task.length, task.coulomb[m], options);
      answer.states[m] = run.finished ? State::kDone
                         : run.lost   ? State::kLost
                                      : State::kUnfinished;
      if (!run.finished) break;
      answer.simulated[m] = {run.x.leftCols(n), run.x.middleCols(n, n)};
      if (ended_early ||
          (answer.simulated[m].q - task.own_q[m]).cwiseAbs().maxCoeff() <=
              options_.tolerance) {
        break;
      }
    }
  }
  return answer;
}

// A stretch has its share of the time that is left, by its samples: what one
// does not use is the others'.
std::vector<SimbodyAnswer> SimbodyRollouts::Run(
    const Trajectory& trajectory, double samples,
    const std::vector<WindowTask>& tasks, const std::vector<int>& order,
    int least) {
  const Clock::time_point start = Clock::now();
  const double share = samples_left_ > samples ? samples / samples_left_ : 1;
  const double seconds = seconds_left_ * share;
  std::vector<SimbodyAnswer> answers(tasks.size());
  std::vector<size_t> at(work_.num_slots());  // in `order`, of each slot
  size_t next = 0;
  work_.Run(
      [&](int slot) {
        const bool in_time =
            static_cast<int>(next) < least || SecondsSince(start) < seconds;
        if (next == order.size() || !in_time) return false;
        at[slot] = next++;
        return true;
      },
      [&](int slot) {
        const int task = order[at[slot]];
        answers[task] = Simulate(trajectory, tasks[task], &engines_[slot]);
      },
      [&](int slot) {
        if (options_.progress) {
          options_.progress("Simbody", (at[slot] + 1.0) / order.size());
        }
      });
  samples_left_ -= samples;
  seconds_left_ = std::max(0.0, seconds_left_ - SecondsSince(start));
  return answers;
}

}  // namespace armcal
