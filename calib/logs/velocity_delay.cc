#include "calib/logs/velocity_delay.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/logs/uniform_series.h"
#include "calib/numerics/lowest_between.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kStretch = .05;          // s
constexpr double kLeastLateness = .0125;  // s; filters and drives have less
constexpr double kMostLateness = .08;     // s, as torques are asked for
constexpr double kLatenessStep = .0025;   // s
constexpr double kAlikeDelays = .3;  // of both halves' delays, of their mean
constexpr double kMostLeft = .5;     // of squares, with and without a delay
constexpr int kParts = 8;            // every second one is a half
constexpr int kLeastStretches = 10;  // of a half

// What a position changes by in stretches, and its velocity's integral over
// the same stretches some time later.
class Stretches {
 public:
  Stretches(const Log& log, int j) : t_(log.t), way_(log.size()) {
    const double dt = (t_[log.size() - 1] - t_[0]) / (log.size() - 1);
    const int rows = std::max(1, static_cast<int>(std::lround(kStretch / dt)));
    way_[0] = 0;
    for (int k = 0; k + 1 < log.size(); ++k) {
      way_[k + 1] = way_[k] + .5 * (log.qd(k, j) + log.qd(k + 1, j)) *
                                  (t_[k + 1] - t_[k]);
    }
    std::vector<double> begins, ends, change;
    for (int begin = 0; begin + rows < log.size(); begin += rows) {
      const int end = begin + rows;
      if (t_[begin] < t_[0] + kMostLateness) continue;
      if (t_[end] > t_[log.size() - 1] - kMostLateness) break;
      begins.push_back(t_[begin]);
      ends.push_back(t_[end]);
      change.push_back(log.q(end, j) - log.q(begin, j));
    }
    const auto size = static_cast<Eigen::Index>(change.size());
    begins_ = Eigen::Map<VectorXd>(begins.data(), size);
    ends_ = Eigen::Map<VectorXd>(ends.data(), size);
    change_ = Eigen::Map<VectorXd>(change.data(), size);
  }

  int size() const { return static_cast<int>(change_.size()); }

  // Of each half: the gain that fits it, and what it leaves of both.
  struct Left {
    double of[2][2] = {};  // [fitted half][judged half]
    bool known = true;
  };
  Left At(double delay) const {
    const VectorXd way = Interpolated(t_, way_, ends_.array() + delay) -
                         Interpolated(t_, way_, begins_.array() + delay);
    double square[2] = {}, product[2] = {};
    for (int s = 0; s < size(); ++s) {
      square[HalfOf(s)] += way[s] * way[s];
      product[HalfOf(s)] += way[s] * change_[s];
    }
    Left left;
    left.known = square[0] > 0 && square[1] > 0;
    for (int fitted = 0; left.known && fitted < 2; ++fitted) {
      const double gain = product[fitted] / square[fitted];
      for (int s = 0; s < size(); ++s) {
        const double error = change_[s] - gain * way[s];
        left.of[fitted][HalfOf(s)] += error * error;
      }
    }
    return left;
  }

 private:
  int HalfOf(int s) const { return s * kParts / size() % 2; }

  const VectorXd t_;
  VectorXd way_;
  VectorXd begins_, ends_, change_;
};

}  // namespace

std::optional<double> VelocityDelay(const Log& log, int j) {
  const Stretches stretches(log, j);
  if (stretches.size() < 2 * kLeastStretches) return {};
  const int reach =
      static_cast<int>(std::lround(kMostLateness / kLatenessStep));
  std::vector<Stretches::Left> left;
  for (int k = -reach; k <= reach; ++k)
    left.push_back(stretches.At(k * kLatenessStep));
  const Stretches::Left& as_is = left[reach];
  double delays[2];
  for (int half = 0; half < 2; ++half) {
    int best = reach;
    for (int k = 0; k <= 2 * reach; ++k) {
      if (!left[k].known) return {};
      if (left[k].of[half][half] < left[best].of[half][half]) best = k;
    }
    // At an end of what was searched nothing is least.
    if (best == 0 || best == 2 * reach) return {};
    if (!(left[best].of[half][1 - half] <
          kMostLeft * as_is.of[half][1 - half])) {
      return {};
    }
    const double off =
        LowestBetween(left[best - 1].of[half][half], left[best].of[half][half],
                      left[best + 1].of[half][half]);
    delays[half] = (best - reach + off) * kLatenessStep;
  }
  const double mean = .5 * (delays[0] + delays[1]);
  if (!(std::abs(mean) > kLeastLateness)) return {};
  if (std::abs(delays[0] - delays[1]) > kAlikeDelays * std::abs(mean))
    return {};
  return mean;
}

}  // namespace armcal
