#include "model/signals/position_spikes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/text/quantile.h"

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kMotion = .02;   // rad/s or m/s
constexpr Index kAroundRows = 3;  // of a slope to both sides
// Times the speed below which nine tenths of the motion are. Sines of several
// frequencies reach 2 to 3 times that, and clocks that skip a row twice it.
constexpr double kFaster = 5;
constexpr double kAround = 5;  // times the smaller one of the steps around
// Of the usual step, which is noise where a joint rests, and of the finest one,
// which is the encoder's resolution.
constexpr double kUsualSteps = 10;
constexpr double kMostJumps = .05;    // of all steps
constexpr double kLongestSpike = .1;  // s, of a spike
constexpr double kBack = .2;  // of its size, to which a spike comes back
// A second difference over the rms of all of them: of noise, however many
// samples, it is below 6, of motion as well but for starts and stops; of a lone
// spike in n samples it is sqrt(2 n / 3).
constexpr double kMayBeASpike = 8;

double QuantileOf(std::vector<double> values, double share) {
  const auto count = static_cast<Index>(values.size());
  return NonnegativeAtRank(values.data(), count,
                           std::min<Index>(count - 1, count * share));
}

// Below which nine tenths of the motion are; of a joint that hardly moves the
// speed from which on it would.
double UsualSpeed(const VectorXd& t, const VectorXd& q) {
  std::vector<double> moving;
  for (Index k = kAroundRows; k + kAroundRows < q.size(); ++k) {
    const double time = t[k + kAroundRows] - t[k - kAroundRows];
    if (!(time > 0)) continue;
    const double speed =
        std::abs(q[k + kAroundRows] - q[k - kAroundRows]) / time;
    if (speed > kMotion) moving.push_back(speed);
  }
  return moving.empty() ? kMotion : QuantileOf(std::move(moving), .9);
}

// What a step has to be larger than.
double LeastJump(const VectorXd& step) {
  std::vector<double> sizes;
  double finest = std::numeric_limits<double>::infinity();
  for (const double size : step.cwiseAbs()) {
    sizes.push_back(size);
    if (size > 0) finest = std::min(finest, size);
  }
  if (!std::isfinite(finest)) return finest;
  return kUsualSteps * std::max(QuantileOf(std::move(sizes), .5), finest);
}

VectorXd StepsOf(const VectorXd& x) {
  return x.tail(x.size() - 1) - x.head(x.size() - 1);
}

bool MayHaveSpikes(const Eigen::Ref<const VectorXd>& q) {
  const Index n = q.size() - 2;
  if (n < 2 * kAroundRows) return false;
  const VectorXd second = q.head(n) - 2 * q.segment(1, n) + q.tail(n);
  const double most = second.cwiseAbs().maxCoeff();
  return most * most * static_cast<double>(n) >
         kMayBeASpike * kMayBeASpike * second.squaredNorm();
}

}  // namespace

// A position that was held for some rows makes up for them in one step, so that
// the speed of a step is since the position last changed.
PositionSteps FindJumps(const VectorXd& t, const VectorXd& q) {
  PositionSteps found;
  const Index count = q.size() - 1;
  if (count < 2 * kAroundRows) return found;
  found.usual_speed = UsualSpeed(t, q);
  const VectorXd step = StepsOf(q), interval = StepsOf(t);
  const double least = LeastJump(step);
  const double usual = found.usual_interval =
      QuantileOf({interval.begin(), interval.end()}, .5);
  double since = t[0];
  for (Index k = 0; k < count; ++k) {
    const double size = std::abs(step[k]);
    const double time = std::max(t[k + 1] - since, usual);
    if (size > 0) since = t[k + 1];
    if (k == 0 || k + 1 == count) continue;
    const double around =
        std::min(std::abs(step[k - 1]), std::abs(step[k + 1]));
    if (size > least && size > kFaster * found.usual_speed * time &&
        size > kAround * around) {
      found.jumps.push_back(static_cast<int>(k));
    }
  }
  if (static_cast<double>(found.jumps.size()) >
      kMostJumps * static_cast<double>(count)) {
    found.jumps.clear();
  }
  return found;
}

std::vector<PositionSpike> TakeSpikes(const VectorXd& t, const VectorXd& q,
                                      PositionSteps* steps) {
  std::vector<PositionSpike> spikes;
  std::vector<int> others;
  const std::vector<int>& jumps = steps->jumps;
  for (size_t i = 0; i < jumps.size(); ++i) {
    const int k = jumps[i];
    const double size = q[k + 1] - q[k];
    const auto is_near = [&](size_t other) {
      return other < jumps.size() && t[jumps[other]] - t[k] <= kLongestSpike;
    };
    size_t back = i + 1;
    while (is_near(back) &&
           std::abs(q[jumps[back] + 1] - q[k]) >
               kBack * std::abs(size) +
                   steps->usual_speed * (t[jumps[back] + 1] - t[k])) {
      ++back;
    }
    if (is_near(back)) {
      spikes.push_back({k + 1, jumps[back] + 1, size});
      i = back;
    } else {
      others.push_back(k);
    }
  }
  steps->jumps = others;
  return spikes;
}

void Bridge(const PositionSpike& spike, const VectorXd& t,
            Eigen::Ref<VectorXd> q) {
  const double t0 = t[spike.begin - 1], time = t[spike.end] - t0;
  const double before = q[spike.begin - 1], after = q[spike.end];
  for (int k = spike.begin; k < spike.end; ++k) {
    const double share = time > 0 ? (t[k] - t0) / time : .5;
    q[k] = before + share * (after - before);
  }
}

long RemovePositionSpikes(const Eigen::Ref<const VectorXd>& t,
                          Eigen::Ref<VectorXd> q) {
  if (!MayHaveSpikes(q)) return 0;
  const VectorXd time = t, recorded = q;
  PositionSteps steps = FindJumps(time, recorded);
  long rows = 0;
  for (const PositionSpike& spike : TakeSpikes(time, recorded, &steps)) {
    Bridge(spike, time, q);
    rows += spike.end - spike.begin;
  }
  return rows;
}

void AddCounts(const SpikeCounts& more, SpikeCounts* all) {
  *all = all->size() == 0 ? more : SpikeCounts(*all + more);
}

}  // namespace armcal
