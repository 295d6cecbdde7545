#include "model/dynamics/batch_rollout.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;

// The states and torques of the windows of one batch, joints a stride apart.
class Lanes {
 public:
  Lanes(int n, int lanes) : n_(n), lanes_(lanes), numbers_(5L * n * lanes) {}

  double* q() { return Part(0); }
  double* qd() { return Part(1); }
  double* coulomb() { return Part(2); }
  double* begin() { return Part(3); }
  double* end() { return Part(4); }

  // Windows first to first + count of the states; those that are no numbers are
  // lost at once. Lanes without a window lie at 0.
  void Load(int first, int count, RolloutStates* states) {
    std::fill_n(q(), 5L * n_ * lanes_, 0.);
    for (int k = 0; k < count; ++k) {
      const int w = first + k;
      if (!states->q.row(w).allFinite() || !states->qd.row(w).allFinite() ||
          !states->coulomb.row(w).allFinite()) {
        states->lost[w] = 0;
        continue;
      }
      for (int j = 0; j < n_; ++j) {
        q()[j * lanes_ + k] = states->q(w, j);
        qd()[j * lanes_ + k] = states->qd(w, j);
        coulomb()[j * lanes_ + k] = states->coulomb(w, j);
      }
    }
  }

  void Store(int first, int count, RolloutStates* states) {
    for (int k = 0; k < count; ++k) {
      for (int j = 0; j < n_; ++j) {
        states->q(first + k, j) = q()[j * lanes_ + k];
        states->qd(first + k, j) = qd()[j * lanes_ + k];
        states->coulomb(first + k, j) = coulomb()[j * lanes_ + k];
      }
    }
  }

 private:
  double* Part(int part) { return numbers_.data() + part * n_ * lanes_; }

  int n_, lanes_;
  AlignedNumbers numbers_;
};

}  // namespace

BatchRollout::BatchRollout(const std::vector<RolloutArm>& arms,
                           const simd::Kernels& kernels)
    : num_arms_(arms.size()), kernels_(&kernels.arms) {
  CHECK(!arms.empty());
  const size_t lanes = kernels_->lanes;
  if (arms.size() == 1) {
    plans_.push_back(std::make_unique<ArmPlan>(arms[0], kernels_->lanes));
    return;
  }
  for (size_t first = 0; first < arms.size(); first += lanes) {
    std::vector<const RolloutArm*> of_lane;
    for (size_t k = 0; k < lanes; ++k) {
      of_lane.push_back(&arms[std::min(first + k, arms.size() - 1)]);
    }
    plans_.push_back(std::make_unique<ArmPlan>(of_lane));
  }
}

// Takes each batch of windows through all steps before the next one, so that
// its state stays in the cache.
void BatchRollout::Run(double begin, double step, long steps,
                       const TorqueLaw& torque, const Visit& visit,
                       RolloutStates* states) const {
  const int n = num_joints(), width = kernels_->lanes;
  const int windows = static_cast<int>(states->q.rows());
  CHECK(states->q.cols() == n && states->qd.rows() == windows &&
        states->qd.cols() == n);
  CHECK(num_arms_ == 1 || num_arms_ == static_cast<size_t>(windows));
  if (states->coulomb.size() == 0) states->coulomb.setZero(windows, n);
  states->lost.assign(windows, -1);
  Lanes lanes(n, width);
  for (int first = 0; first < windows; first += width) {
    const int count = std::min(width, windows - first);
    const simd::ArmConstants& arm = PlanOf(first / width).constants();
    lanes.Load(first, count, states);
    const simd::ArmState state = {lanes.q(), lanes.qd(), lanes.coulomb(),
                                  width};
    Batch at = {first, count,     0,          begin,
                width, lanes.q(), lanes.qd(), lanes.coulomb()};
    for (long k = 1; k <= steps; ++k) {
      torque(at, lanes.begin(), lanes.end());
      const unsigned lost =
          kernels_->advance(arm, step, lanes.begin(), lanes.end(), state);
      for (int lane = 0; lost != 0 && lane < count; ++lane) {
        long& when = states->lost[first + lane];
        if ((lost >> lane & 1) != 0 && when < 0) when = k;
      }
      at.step = k;
      at.t = begin + static_cast<double>(k) * step;
      if (visit) visit(at);
    }
    lanes.Store(first, count, states);
  }
}

}  // namespace armcal
