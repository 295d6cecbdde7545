#include "calib/linear/torque_outliers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "model/signals/spikes.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMedianReach = 15;
// A jump of the residual is an error of the sample only where the torque makes
// it, not the prediction.
constexpr double kLeastJump = 0.5;
constexpr double kLeastOfRms = 0.01;  // of the torque's rms

// By how much Coulomb friction may be above what is predicted at a place of the
// grid, or below it (`sign` -1), where its state may be that of any time within
// `reach` rows: of all where the joint turns round.
double MayDiffer(const Eigen::Ref<const VectorXd>& coulomb, double place,
                 int reach, int sign) {
  const auto at = std::clamp(std::lround(place), 0L, coulomb.size() - 1L);
  const long begin = std::max(0L, at - reach);
  const long end = std::min(coulomb.size() - 1L, at + reach);
  const auto near = sign * coulomb.segment(begin, end - begin + 1).array();
  return near.maxCoeff() - sign * coulomb[at];
}

// Adds the gross errors of one joint in the trajectory's core. `level` is the
// running median of the residuals, so that what the model lacks for longer than
// a few samples is no error. A sample's torque must itself jump from its
// neighbours', or a jump of the prediction (friction at a reversal) would take
// out good samples exactly where friction is told. And where friction may
// differ by as much, its torque must be unlike that of either neighbour:
// friction that turns over some samples sooner or later than is predicted is a
// step, on one side of which the sample is.
void Judge(const Trajectory& t, const SampleResiduals& residuals, int joint,
           int reach, std::vector<TorqueOutlier>* list) {
  const TorqueSamples& s = t.samples;
  const VectorXd tau = s.tau.col(joint);
  const double rms = tau.norm() / std::sqrt(std::max<double>(1, tau.size()));
  const VectorXd residual = residuals.residual.col(joint);
  const VectorXd coulomb = residuals.coulomb.col(joint);
  const double least = kLeastOfRms * rms;
  const Outlying found = FindOutlying(residual, kMedianReach, least);
  for (int k = 0; k < s.size(); ++k) {
    const bool in_core = s.place[k] >= t.core_begin && s.place[k] < t.core_end;
    if (!in_core || !found.marked[k]) continue;
    const double size = residual[k] - found.level[k];
    const bool is_friction =
        std::abs(size) <
        found.limit + MayDiffer(coulomb, s.place[k], reach, size > 0 ? 1 : -1);
    const double jump =
        is_friction
            ? std::abs((tau[k] - NearerEnd(tau, k, found.marked)) / size)
            : (tau[k] - Bridge(tau, k, found.marked)) / size;
    if (jump < kLeastJump) continue;
    list->push_back({s.row[k], s.t[k], joint, tau[k], tau[k] - residual[k],
                     size / std::max(found.deviation, least / 8)});
  }
}

}  // namespace

// Joints are judged side by side; lists are sorted, so that their order does
// not tell which thread was first.
OutlierLists FindTorqueOutliers(SamplePass* pass) {
  OutlierLists lists(pass->num_logs());
  pass->Run("outliers", [&](int log, const Trajectory& t,
                            const SampleResiduals& residuals) {
    const int n = t.num_joints();
    const int reach = static_cast<int>(std::ceil(pass->turn_reach() / t.dt));
    std::vector<std::vector<TorqueOutlier>> found(n);
    tbb::parallel_for(0, n,
                      [&](int i) { Judge(t, residuals, i, reach, &found[i]); });
    for (const std::vector<TorqueOutlier>& of_joint : found) {
      lists[log].insert(lists[log].end(), of_joint.begin(), of_joint.end());
    }
  });
  for (std::vector<TorqueOutlier>& list : lists) {
    std::sort(list.begin(), list.end(),
              [](const TorqueOutlier& a, const TorqueOutlier& b) {
                return a.row != b.row ? a.row < b.row : a.joint < b.joint;
              });
  }
  return lists;
}

bool SameSamples(const OutlierLists& a, const OutlierLists& b) {
  if (a.size() != b.size()) return false;
  for (size_t log = 0; log < a.size(); ++log) {
    const bool same =
        std::equal(a[log].begin(), a[log].end(), b[log].begin(), b[log].end(),
                   [](const TorqueOutlier& p, const TorqueOutlier& q) {
                     return p.row == q.row && p.joint == q.joint;
                   });
    if (!same) return false;
  }
  return true;
}

}  // namespace armcal
