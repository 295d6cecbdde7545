#include "model/dynamics/batch_torque_replay.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLongestStep = 4e-3;        // s
constexpr double kShortestStep = 1e-3 / 64;  // s
// At these a window that does not stay in bounds is given up.
constexpr double kShortStep = 1e-3 / 2;     // s
constexpr double kVelocityTolerance = 100;  // 1/s
constexpr double kGivenUpAngle = 100;       // rad
constexpr double kGivenUpLength = 10;       // m

// Whether two replays of a window say the same.
bool Agree(const ReplayedWindow& a, const ReplayedWindow& b, double tolerance) {
  if (!a.finished || !b.finished) return false;
  return (a.q - b.q).cwiseAbs().maxCoeff() <= tolerance &&
         (a.qd - b.qd).cwiseAbs().maxCoeff() <= kVelocityTolerance * tolerance;
}

}  // namespace

std::vector<JointTermColumn> CoulombColumns(
    const std::vector<CoulombTransition>& transitions) {
  std::vector<JointTermColumn> columns;
  for (size_t j = 0; j < transitions.size(); ++j) {
    columns.push_back(
        {static_cast<int>(j), JointTerm::kCoulomb, transitions[j]});
  }
  return columns;
}

BatchTorqueReplay::BatchTorqueReplay(const Robot& robot,
                                     std::vector<CoulombTransition> transitions,
                                     const simd::Kernels& kernels)
    : lost_(robot.num_joints()),
      coulomb_(CoulombColumns(transitions)),
      rollout_({{robot, std::move(transitions), {}}}, kernels) {
  for (int j = 0; j < robot.num_joints(); ++j) {
    lost_[j] = IsRotational(robot.links[j].joint.type) ? kGivenUpAngle
                                                       : kGivenUpLength;
  }
}

// Simulates qdd = M^-1 (tau - c - g - friction) with the recorded torque,
// linear between samples, in equal steps. Equal ones let all windows go in
// lanes.
std::vector<ReplayedWindow> BatchTorqueReplay::RunInSteps(
    const Trajectory& trajectory, const std::vector<int>& first, int length,
    const MatrixXd& coulomb, int steps_per_sample) const {
  const int n = num_joints();
  RolloutStates states{trajectory.q(first, Eigen::all),
                       trajectory.qd(first, Eigen::all),
                       coulomb(first, Eigen::all),
                       {}};
  std::vector<ReplayedWindow> windows(
      first.size(),
      {true, MatrixXd::Zero(length, n), MatrixXd::Zero(length, n)});
  const auto torque = [&](const BatchRollout::Batch& at, double* begin,
                          double* end) {
    const long sample = at.step / steps_per_sample;
    const double share = 1. / steps_per_sample;
    const double from = static_cast<double>(at.step % steps_per_sample) * share;
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < at.count; ++k) {
        const long row = first[at.first + k] + sample;
        const double tau = trajectory.tau(row, j);
        const double rise = trajectory.tau(row + 1, j) - tau;
        begin[j * at.stride + k] = tau + from * rise;
        end[j * at.stride + k] = tau + (from + share) * rise;
      }
    }
  };
  const auto visit = [&](const BatchRollout::Batch& at) {
    if (at.step % steps_per_sample != 0) return;
    const long sample = at.step / steps_per_sample;
    for (int k = 0; k < at.count; ++k) {
      ReplayedWindow& window = windows[at.first + k];
      for (int j = 0; j < n; ++j) {
        const double q = at.q[j * at.stride + k];
        window.q(sample - 1, j) = q;
        window.qd(sample - 1, j) = at.qd[j * at.stride + k];
        const double recorded = trajectory.q(first[at.first + k] + sample, j);
        if (std::abs(q - recorded) >= lost_[j]) window.finished = false;
      }
    }
  };
  rollout_.Run(0, trajectory.dt / steps_per_sample,
               static_cast<long>(length) * steps_per_sample, torque, visit,
               &states);
  for (size_t w = 0; w < windows.size(); ++w) {
    if (states.lost[w] >= 0) windows[w].finished = false;
  }
  return windows;
}

// Halves the steps until a window no longer changes. The change by a halving
// bounds the error that is left: it is a fifteenth of the change at order 4 and
// no more than the change at order 1, to which stiff friction may reduce it.
// Windows that agree leave the batch.
std::vector<ReplayedWindow> BatchTorqueReplay::Run(
    const Trajectory& trajectory, const std::vector<int>& first, int length,
    const MatrixXd& coulomb, double tolerance) const {
  CHECK(coulomb.rows() == trajectory.size() && coulomb.cols() == num_joints());
  std::vector<ReplayedWindow> finished(first.size());
  if (first.empty()) return finished;
  for (const int k : first) CHECK(k >= 0 && k + length < trajectory.size());
  std::vector<int> open(first.size()), rows = first;  // still to be replayed
  for (size_t w = 0; w < open.size(); ++w) open[w] = static_cast<int>(w);
  int steps = std::max(
      1, static_cast<int>(std::ceil(trajectory.dt / kLongestStep - 1e-9)));
  std::vector<ReplayedWindow> coarse =
      RunInSteps(trajectory, rows, length, coulomb, steps);
  while (!open.empty() && trajectory.dt / steps > kShortestStep) {
    steps *= 2;
    std::vector<ReplayedWindow> fine =
        RunInSteps(trajectory, rows, length, coulomb, steps);
    size_t left = 0;
    for (size_t w = 0; w < open.size(); ++w) {
      if (Agree(coarse[w], fine[w], tolerance)) {
        finished[open[w]] = std::move(fine[w]);
        continue;
      }
      if (!coarse[w].finished && !fine[w].finished &&
          trajectory.dt / steps < kShortStep) {
        continue;
      }
      open[left] = open[w];
      rows[left] = rows[w];
      coarse[left++] = std::move(fine[w]);
    }
    open.resize(left);
    rows.resize(left);
    coarse.resize(left);
  }
  return finished;
}

}  // namespace armcal
