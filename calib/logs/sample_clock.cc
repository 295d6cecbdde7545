#include "calib/logs/sample_clock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "calib/logs/velocity_law.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kRateWindow =
    .1;                          // s: the period of the 10 Hz to which torques
                                 // are compared, so what a fit sees of a clock
constexpr int kLeastSteps = 10;  // in a window
// What a rate has to be off by to be told, and to be known to. Inertias go with
// its square: 2 %, what calibrations of one robot agree to.
constexpr double kLeastRate = .01;
// A correlation of .7 over 20 windows is 4 standard deviations of none.
constexpr int kLeastWindows = 20;
// The square of the groups' correlation: each explains more than half of the
// other's variance.
constexpr double kExplained = .5;
constexpr double kSurely = 3;  // standard deviations

// Sums over joints of a step, or over steps: what is told of time.
struct TimeSums {
  double product = 0;   // sum v dq / s^2
  double square = 0;    // sum v^2 / s^2
  double by_stamp = 0;  // sum v^2 dt / s^2

  void Add(const TimeSums& other) {
    product += other.product;
    square += other.square;
    by_stamp += other.by_stamp;
  }
  double rate() const { return product / by_stamp; }
  double rate_stddev() const { return std::sqrt(square) / by_stamp; }
  double step() const { return product / square; }
  double step_variance() const { return 1 / square; }
};

struct Window {
  Eigen::Index begin, end;  // steps
  std::array<TimeSums, 2> groups;
  bool tells = false;
  double rate = 1;  // of all joints
};

double Covariance(const std::vector<double>& x, const std::vector<double>& y) {
  const auto size = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, product = 0;
  for (size_t k = 0; k < x.size(); ++k) {
    mean_x += x[k] / size;
    mean_y += y[k] / size;
    product += x[k] * y[k] / size;
  }
  return product - mean_x * mean_y;
}

double Correlation(const std::vector<double>& x, const std::vector<double>& y) {
  return Covariance(x, y) /
         std::sqrt(Covariance(x, x) * Covariance(y, y) + 1e-300);
}

class ClockEstimate {
 public:
  explicit ClockEstimate(const Log& log)
      : steps_(FitVelocityLaws(log)), size_(steps_.dt.size()) {
    for (size_t j = 0; j < steps_.laws.size(); ++j) {
      if (steps_.laws[j].usable) joints_.push_back(static_cast<int>(j));
    }
    variance_ = VectorXd::Ones(steps_.v.cols());
  }

  SampleClock Run() {
    if (joints_.size() < 2) return clock_;
    EstimateNoise();
    if (!MakeGroups()) return clock_;
    MakeWindows();
    Judge();
    if (clock_.wrong() || clock_.jitters) Rebuild();
    if (clock_.jitters) clock_.t /= clock_.rate;
    return clock_;
  }

 private:
  TimeSums Sums(const std::vector<int>& joints, Eigen::Index k) const {
    TimeSums sums;
    for (const int j : joints) {
      const double v = steps_.v(k, j) / variance_[j];
      sums.product += v * steps_.change(k, j);
      sums.square += v * steps_.v(k, j);
    }
    sums.by_stamp = sums.square * steps_.dt[k];
    return sums;
  }

  // The variance of each joint's dq beside the steps that all joints tell, so
  // that it is not the clock's. A joint's own share in these is given back: its
  // residual has 1 - v_j^2 / s_j^2 / (sum of all) of its variance.
  void EstimateNoise() {
    constexpr int kRounds = 5;
    for (const int j : joints_) {
      variance_[j] = steps_.change.col(j).squaredNorm() / size_ + 1e-300;
    }
    for (int round = 0; round < kRounds; ++round) {
      VectorXd squares = VectorXd::Zero(variance_.size()), free = squares;
      for (Eigen::Index k = 0; k < size_; ++k) {
        const TimeSums sums = Sums(joints_, k);
        if (!(sums.square > 0)) continue;
        for (const int j : joints_) {
          const double v = steps_.v(k, j);
          const double left = steps_.change(k, j) - v * sums.step();
          squares[j] += left * left;
          free[j] += 1 - v * v / variance_[j] / sums.square;
        }
      }
      for (const int j : joints_) {
        // What is exact would have all of the weight.
        const double least = 1e-12 * steps_.change.col(j).squaredNorm() / size_;
        variance_[j] = squares[j] / std::max(free[j], 1.) + least + 1e-300;
      }
    }
  }

  // The joint that tells most first, each to the group that knows less.
  bool MakeGroups() {
    std::vector<std::pair<double, int>> order;
    for (const int j : joints_) {
      const double square =
          steps_.v.col(j).cwiseProduct(steps_.dt).squaredNorm();
      order.emplace_back(-square / variance_[j], j);
    }
    std::sort(order.begin(), order.end());
    std::array<double, 2> known = {0, 0};
    for (const auto& [information, j] : order) {
      const int to = known[0] > known[1] ? 1 : 0;
      groups_[to].push_back(j);
      known[to] -= information;
    }
    return known[0] > 0 && known[1] > 0;
  }

  void MakeWindows() {
    const double length = steps_.dt.sum();
    const double least = std::max(
        kRateWindow, kLeastSteps * length / static_cast<double>(size_));
    double time = 0;
    Window window{0, 0, {}};
    for (Eigen::Index k = 0; k < size_; ++k) {
      for (int g = 0; g < 2; ++g) window.groups[g].Add(Sums(groups_[g], k));
      time += steps_.dt[k];
      if (time < least) continue;
      window.end = k + 1;
      windows_.push_back(window);
      window = {k + 1, 0, {}};
      time = 0;
    }
    for (Window& w : windows_) {
      w.tells = w.groups[0].rate_stddev() < kLeastRate &&
                w.groups[1].rate_stddev() < kLeastRate;
      TimeSums both = w.groups[0];
      both.Add(w.groups[1]);
      w.rate = both.rate();
    }
  }

  void Judge() {
    std::vector<double> rates[2], all;
    for (const Window& w : windows_) {
      if (!w.tells) continue;
      for (int g = 0; g < 2; ++g) rates[g].push_back(w.groups[g].rate());
      all.push_back(w.rate);
    }
    clock_.windows = static_cast<int>(all.size());
    if (clock_.windows < kLeastWindows) return;
    const auto count = static_cast<double>(clock_.windows);
    const auto mean = [&](const std::vector<double>& x) {
      double sum = 0;
      for (const double value : x) sum += value / count;
      return sum;
    };
    clock_.rate = mean(all);
    clock_.period = clock_.rate * steps_.dt.mean();
    clock_.period_stddev =
        steps_.dt.mean() * std::sqrt(Covariance(all, all) / count);
    const double off = clock_.rate - 1;
    clock_.wrong_rate =
        std::abs(off) > kLeastRate &&
        std::abs(mean(rates[0]) - mean(rates[1])) < .5 * std::abs(off);
    for (const auto& rate : rates) {
      const double sure = kSurely * std::sqrt(Covariance(rate, rate) / count);
      if (!((mean(rate) - 1) * (off < 0 ? -1 : 1) >
            std::max(.5 * kLeastRate, sure))) {
        clock_.wrong_rate = false;
      }
    }
    const double shared = Covariance(rates[0], rates[1]);
    clock_.correlation = Correlation(rates[0], rates[1]);
    clock_.wander = std::sqrt(std::max(0., shared));
    clock_.uneven = clock_.wander > kLeastRate && clock_.correlation > 0 &&
                    clock_.correlation * clock_.correlation > kExplained;
    if (!clock_.uneven && !JointsAgree(off)) clock_.wrong_rate = false;
    JudgeSteps();
  }

  // Errors below a hundredth of a step are not asked about: models of the
  // motion between two rows have such. Where an arm rests for long its steps
  // are unknown, and no jitter is told.
  void JudgeSteps() {
    const auto deviations = StepDeviations();
    const double shared = Covariance(deviations[0], deviations[1]);
    const double step = steps_.dt.mean();
    clock_.jitter = std::sqrt(std::max(0., shared));
    clock_.step_correlation = Correlation(deviations[0], deviations[1]);
    clock_.jitters =
        !clock_.wrong() && clock_.jitter > kLeastRate * step &&
        clock_.jitter < step &&
        clock_.step_correlation * clock_.step_correlation > kExplained;
  }

  // Whether each joint that knows its own gain well has the rate's: of an even
  // clock all have, where scaled velocities of some joints would be a mean of
  // theirs and others'.
  bool JointsAgree(double off) const {
    for (const int j : joints_) {
      const double way = steps_.v.col(j).cwiseProduct(steps_.dt).norm();
      const double known = kSurely * std::sqrt(variance_[j]) / way;
      const double apart = std::abs(steps_.laws[j].gain - 1 - off);
      if (known < .5 * std::abs(off) && apart > .5 * std::abs(off)) {
        return false;
      }
    }
    return true;
  }

  // What each group finds single steps to differ from the stamps' by, s, beside
  // the mean rate.
  std::array<std::vector<double>, 2> StepDeviations() const {
    std::array<std::vector<double>, 2> deviations;
    for (const Window& w : windows_) {
      for (Eigen::Index k = w.begin; w.tells && k < w.end; ++k) {
        const TimeSums sums[2] = {Sums(groups_[0], k), Sums(groups_[1], k)};
        if (!(sums[0].square > 0 && sums[1].square > 0)) continue;
        for (int g = 0; g < 2; ++g) {
          deviations[g].push_back(sums[g].step() - clock_.rate * steps_.dt[k]);
        }
      }
    }
    return deviations;
  }

  // Each step is what the joints say, drawn to its window's rate as far as they
  // do not know it: the best linear estimate for steps that vary by what both
  // groups share. The noise of a position enters the two steps beside it with
  // opposite signs and goes out of the sum, so that time does not drift.
  void Rebuild() {
    const double vary = clock_.jitter * clock_.jitter;
    clock_.t = VectorXd::Zero(size_ + 1);
    size_t w = 0;
    for (Eigen::Index k = 0; k < size_; ++k) {
      while (w + 1 < windows_.size() && windows_[w].end <= k) ++w;
      const Window& window = windows_[w];
      const double rate = window.tells ? window.rate : clock_.rate;
      const double expected = rate * steps_.dt[k];
      const TimeSums sums = Sums(joints_, k);
      double step = expected;
      if (window.tells && sums.square > 0) {
        const double share = vary / (vary + sums.step_variance());
        step += share * (sums.step() - expected);
        Count(sums, share);
      }
      if (IsRepeated(k, sums)) step = 0;
      clock_.t[k + 1] = clock_.t[k] + std::max(0., step);
    }
  }

  // Nothing moves on while velocities say that something does, by more than the
  // standard deviation of what they say: an arm that rests repeats rounded
  // positions.
  bool IsRepeated(Eigen::Index k, const TimeSums& sums) const {
    return steps_.still[k] && sums.square * steps_.dt[k] * steps_.dt[k] > 1;
  }

  void Count(const TimeSums& sums, double share) {
    if (share < .9) return;  // one step is not known well enough
    if (sums.step() < .5 * clock_.period) ++clock_.repeated;
    if (sums.step() > 1.5 * clock_.period) ++clock_.skipped;
  }

  const VelocitySteps steps_;
  const Eigen::Index size_;
  std::vector<int> joints_;
  VectorXd variance_;  // of the joints' dq
  std::array<std::vector<int>, 2> groups_;
  std::vector<Window> windows_;
  SampleClock clock_;
};

}  // namespace

SampleClock EstimateSampleClock(const Log& log) {
  if (log.qd.size() == 0 || log.size() < 4) return {};
  return ClockEstimate(log).Run();
}

}  // namespace armcal
