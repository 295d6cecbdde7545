#include "calib/verify/rollout_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "calib/numerics/block_bootstrap.h"
#include "calib/numerics/undefined.h"

namespace armcal {
namespace {

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

EngineErrors MedianErrorsByEngine(const Rollouts& rollouts, int model,
                                  const std::vector<int>& joints) {
  std::vector<double> simbody, own;
  for (const RolloutWindow& window : rollouts.windows) {
    if (!window.in_simbody(model)) continue;
    simbody.push_back(window.Error(model, joints));
    own.push_back(window.OwnError(model, joints));
  }
  return {static_cast<int>(own.size()), InterpolatedMedian(std::move(simbody)),
          InterpolatedMedian(std::move(own))};
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
