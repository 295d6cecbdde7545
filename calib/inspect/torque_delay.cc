#include "calib/inspect/torque_delay.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calib/numerics/lowest_between.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDelayStep = .005;  // s
constexpr int kDelaySteps = 16;      // steps to either side: 80 ms
// What a fit leaves are a model's errors, which last as long as the motion
// does: so many samples of them are independent of each other, as many as a
// log has stretches that are held out.
constexpr double kIndependent = 32;
// Nats by which a profile rises within two standard deviations.
constexpr double kTwoDeviations = 2;
constexpr double kOfInterval = 1.96;  // standard deviations, of 95 %
// Of the torque's squares: no model leaves less than 1 % of the torque.
constexpr double kLeastLeft = 1e-4;

struct ToldDelay {
  double delay, variance;
};

double DelayAt(double step) { return (step - kDelaySteps) * kDelayStep; }

// Where the parabola through the least value and its neighbours is least.
double LowestDelay(const VectorXd& profile, Eigen::Index k) {
  return DelayAt(static_cast<double>(k) +
                 LowestBetween(profile[k - 1], profile[k], profile[k + 1]));
}

bool IsInside(const VectorXd& profile, Eigen::Index k) {
  return k > 0 && k + 1 < profile.size();
}

// Of one joint's profile, in nats; nothing where it does not rise on both sides
// within what was searched.
std::optional<ToldDelay> DelayOf(const VectorXd& profile) {
  Eigen::Index k = 0;
  const double least = profile.minCoeff(&k);
  if (!IsInside(profile, k)) return std::nullopt;
  Eigen::Index low = k, high = k;
  while (low >= 0 && profile[low] < least + kTwoDeviations) --low;
  while (high < profile.size() && profile[high] < least + kTwoDeviations) {
    ++high;
  }
  if (low < 0 || high == profile.size()) return std::nullopt;
  const double stddev = static_cast<double>(high - low) * kDelayStep / 4;
  return ToldDelay{LowestDelay(profile, k), stddev * stddev};
}

void SetMean(const std::vector<ToldDelay>& told, TorqueDelay* result) {
  const auto mean = [&](double scatter, double* weights) {
    double product = 0;
    *weights = 0;
    for (const ToldDelay& t : told) {
      *weights += 1 / (t.variance + scatter);
      product += t.delay / (t.variance + scatter);
    }
    return product / *weights;
  };
  double weights = 0, squares = 0, apart = 0;
  const double alike = mean(0, &weights);
  for (const ToldDelay& t : told) {
    squares += 1 / (t.variance * t.variance);
    apart += std::pow(t.delay - alike, 2) / t.variance;
  }
  const double expected = static_cast<double>(told.size()) - 1;
  const double scatter =
      std::max(0., (apart - expected) / (weights - squares / weights));
  result->mean = mean(scatter, &weights);
  result->stddev = 1 / std::sqrt(weights);
}

}  // namespace

bool TorqueDelay::IsBeyond(double least) const {
  return known && std::abs(mean) - kOfInterval * stddev > least;
}

TorqueDelay FindTorqueDelay(const TorqueFit& fit,
                            const std::function<MatrixXd(double)>& torques,
                            const std::vector<bool>& asked) {
  const auto n = static_cast<Eigen::Index>(asked.size());
  MatrixXd profiles(2 * kDelaySteps + 1, n);  // nats
  for (int k = 0; k <= 2 * kDelaySteps; ++k) {
    const MatrixXd tau = torques(DelayAt(k));
    const VectorXd all = fit.InMotion(tau).colwise().squaredNorm();
    const VectorXd left = fit.Squares(fit.Parameters(tau), tau);
    for (Eigen::Index j = 0; j < n; ++j) {
      const double share = left[j] / (all[j] + 1e-18) + kLeastLeft;
      profiles(k, j) = .5 * kIndependent * std::log(share);
    }
  }
  TorqueDelay result;
  std::vector<ToldDelay> told;
  VectorXd sum = VectorXd::Zero(2 * kDelaySteps + 1);
  for (Eigen::Index j = 0; j < n; ++j) {
    if (!asked[j]) continue;
    sum += profiles.col(j);
    if (const auto one = DelayOf(profiles.col(j))) told.push_back(*one);
  }
  Eigen::Index k = 0;
  sum.minCoeff(&k);
  result.inside = IsInside(sum, k);
  result.best =
      result.inside ? LowestDelay(sum, k) : DelayAt(static_cast<double>(k));
  result.joints = static_cast<int>(told.size());
  const auto of = std::count(asked.begin(), asked.end(), true);
  result.known = told.size() > 1 && 2 * static_cast<long>(told.size()) > of;
  if (result.known) SetMean(told, &result);
  return result;
}

}  // namespace armcal
