#include "calib/logs/sample_clock.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "calib/logs/step_information.h"

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
      : told_(log), steps_(told_.steps()), size_(told_.size()) {}

  SampleClock Run() {
    if (!told_.has_groups()) return clock_;
    MakeWindows();
    Judge();
    if (clock_.wrong() || clock_.jitters) Rebuild();
    if (clock_.jitters) clock_.t /= clock_.rate;
    return clock_;
  }

 private:
  void MakeWindows() {
    const double length = steps_.dt.sum();
    const double least = std::max(
        kRateWindow, kLeastSteps * length / static_cast<double>(size_));
    double time = 0;
    Window window{0, 0, {}};
    for (Eigen::Index k = 0; k < size_; ++k) {
      for (int g = 0; g < 2; ++g) window.groups[g].Add(told_.OfGroup(g, k));
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
    for (const int j : told_.joints()) {
      const double way = steps_.v.col(j).cwiseProduct(steps_.dt).norm();
      const double known = kSurely * std::sqrt(told_.variance(j)) / way;
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
        const TimeSums sums[2] = {told_.OfGroup(0, k), told_.OfGroup(1, k)};
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
      const TimeSums sums = told_.OfAll(k);
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

  const StepInformation told_;
  const VelocitySteps& steps_;
  const Eigen::Index size_;
  std::vector<Window> windows_;
  SampleClock clock_;
};

}  // namespace

SampleClock EstimateSampleClock(const Log& log) {
  if (log.qd.size() == 0 || log.size() < 4) return {};
  return ClockEstimate(log).Run();
}

}  // namespace armcal
