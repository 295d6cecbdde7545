#include "model/signals/position_spikes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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
// samples, it is below 6, of motion as well but for starts and stops. In n
// samples a lone spike of one row has the square 2 n / 3, at an end n, and of
// several rows n / 4: of a short stretch an eighth of n is asked for, so that
// two of these show, too.
constexpr double kMayBeASpike = 8;
constexpr double kOfShort = 1. / 8;
constexpr double kHole = 3;  // usual intervals, at which a stretch ends

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
  const auto count = static_cast<double>(n);
  const double asked = std::min(kMayBeASpike * kMayBeASpike, kOfShort * count);
  return most * most * count > asked * second.squaredNorm();
}

// Where the stretch of rows around row k ends within a tenth of a second, by
// `way`: -1 towards its beginning, 1 towards its end; -1 where it does not. The
// other side of a hole is known, and the joint has to be back there.
int EndWithin(const VectorXd& t, const VectorXd& q, int k, int way,
              const PositionSteps& steps, const StretchEnds& ends) {
  const auto last = static_cast<int>(t.size()) - 1;
  const int good = k - way;
  const double size = std::abs(q[k] - q[good]);
  for (int row = k; std::abs(t[row] - t[k]) <= kLongestSpike; row += way) {
    if (row == (way < 0 ? 0 : last)) {
      return (way < 0 ? ends.first : ends.last) ? row : -1;
    }
    const int next = row + way;
    if (std::abs(t[next] - t[row]) > kHole * steps.usual_interval) {
      const double reach = steps.usual_speed * std::abs(t[next] - t[good]);
      const bool back = std::abs(q[next] - q[good]) < kBack * size + reach;
      return back ? row : -1;
    }
  }
  return -1;
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
  const double least = found.least = LeastJump(step);
  const double usual = found.usual_interval =
      QuantileOf({interval.begin(), interval.end()}, .5);
  double since = t[0];
  for (Index k = 0; k < count; ++k) {
    const double size = std::abs(step[k]);
    const double time = std::max(t[k + 1] - since, usual);
    if (size > 0) since = t[k + 1];
    // At an end there is one step beside it.
    const double around =
        std::min(std::abs(step[k == 0 ? 1 : k - 1]),
                 std::abs(step[k + 1 == count ? k - 1 : k + 1]));
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
                                      const StretchEnds& ends,
                                      PositionSteps* steps) {
  std::vector<PositionSpike> spikes;
  std::vector<int> others;
  const std::vector<int>& jumps = steps->jumps;
  for (size_t i = 0; i < jumps.size(); ++i) {
    const int k = jumps[i];
    const double size = q[k + 1] - q[k];
    const auto is_near = [&](size_t other) {
      return other < jumps.size() &&
             t[jumps[other]] - t[k + 1] <= kLongestSpike;
    };
    // What leaves its motion jumps back again. Two steps over rows that are
    // missing go the same way, both.
    size_t back = i + 1;
    for (double since = 0; is_near(back); ++back) {
      const int last = jumps[back];
      since += q[last + 1] - q[last];
      if (since * size < 0 &&
          std::abs(q[last + 1] - q[k]) <=
              kBack * std::abs(size) +
                  steps->usual_speed * (t[last + 1] - t[k])) {
        break;
      }
    }
    const int begin = EndWithin(t, q, k, -1, *steps, ends);
    const int end = EndWithin(t, q, k + 1, 1, *steps, ends);
    if (is_near(back)) {
      spikes.push_back({k + 1, jumps[back] + 1, size});
      i = back;
    } else if (begin >= 0) {
      spikes.push_back({begin, k + 1, -size});
    } else if (end >= 0) {
      spikes.push_back({k + 1, end + 1, size});
    } else {
      others.push_back(k);
    }
  }
  steps->jumps = others;
  return spikes;
}

std::vector<PositionSpike> WrongRows(
    const std::vector<std::vector<PositionSpike>>& of_joints) {
  std::map<int, int> joints;  // at each row with a spike
  for (const auto& spikes : of_joints) {
    for (const PositionSpike& spike : spikes) {
      for (int row = spike.begin; row < spike.end; ++row) ++joints[row];
    }
  }
  std::vector<PositionSpike> wrong;
  for (const auto& [row, count] : joints) {
    if (count < 2) continue;
    if (wrong.empty() || wrong.back().end < row) wrong.push_back({row, row});
    wrong.back().end = row + 1;
  }
  return wrong;
}

void Bridge(const PositionSpike& spike, const VectorXd& t,
            Eigen::Ref<VectorXd> column) {
  const auto rows = static_cast<int>(t.size());
  // The rows whose line they go on; at an end as many rows further in.
  int from = spike.begin - 1, to = spike.end;
  const int length = spike.end - spike.begin;
  if (from < 0) {
    from = std::min(to + length, rows - 1);
  } else if (to >= rows) {
    to = std::max(0, from - length);
  }
  if (from < 0 || to >= rows) return;  // nothing is known
  const double t0 = t[from], time = t[to] - t0;
  const double before = column[from], after = column[to];
  for (int k = spike.begin; k < spike.end; ++k) {
    const double share = time != 0 ? (t[k] - t0) / time : .5;
    column[k] = before + share * (after - before);
  }
}

std::vector<PositionSpike> FindSpikes(const Eigen::Ref<const VectorXd>& t,
                                      const Eigen::Ref<const VectorXd>& q,
                                      const StretchEnds& ends) {
  if (!MayHaveSpikes(q)) return {};
  const VectorXd time = t, recorded = q;
  PositionSteps steps = FindJumps(time, recorded);
  return TakeSpikes(time, recorded, ends, &steps);
}

long RemovePositionSpikes(const Eigen::Ref<const VectorXd>& t,
                          Eigen::Ref<VectorXd> q) {
  long rows = 0;
  for (const PositionSpike& spike : FindSpikes(t, q)) {
    Bridge(spike, t, q);
    rows += spike.end - spike.begin;
  }
  return rows;
}

void AddCounts(const SpikeCounts& more, SpikeCounts* all) {
  *all = all->size() == 0 ? more : SpikeCounts(*all + more);
}

}  // namespace armcal
