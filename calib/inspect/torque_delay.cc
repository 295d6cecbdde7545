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
// Of the motion; two neighbours are left out at a time, an eighth, so that an
// event of less than a piece, such as a single step or the only time that a
// joint turns round, is left out with them wherever it lies.
constexpr int kPieces = 16;

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

// Of one joint: what fits leave of its torque, over delays.
class JointProfile {
 public:
  // Squares over those of the torque, delays x pieces.
  explicit JointProfile(MatrixXd left) : left_(std::move(left)) {}

  // Of all pieces but two neighbours, the first of them given (-1: of all);
  // nothing where it does not rise on both sides within what was searched.
  std::optional<ToldDelay> Delay(int without) const {
    const VectorXd nats = Nats(without);
    Eigen::Index k = 0;
    const double least = nats.minCoeff(&k);
    if (!IsInside(nats, k)) return std::nullopt;
    Eigen::Index low = k, high = k;
    while (low >= 0 && nats[low] < least + kTwoDeviations) --low;
    while (high < nats.size() && nats[high] < least + kTwoDeviations) ++high;
    if (low < 0 || high == nats.size()) return std::nullopt;
    const double stddev = static_cast<double>(high - low) * kDelayStep / 4;
    return ToldDelay{LowestDelay(nats, k), stddev * stddev};
  }

 private:
  VectorXd Nats(int without) const {
    VectorXd sum = left_.rowwise().sum();
    if (without >= 0) sum -= left_.middleCols(without, 2).rowwise().sum();
    return .5 * kIndependent * (sum.array() + kLeastLeft).log().matrix();
  }

  MatrixXd left_;
};

void SetMeanOf(const std::vector<ToldDelay>& told, TorqueDelay* result) {
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
  // One has no scatter.
  const double scatter =
      told.size() > 1
          ? std::max(0., (apart - expected) / (weights - squares / weights))
          : 0;
  result->mean = mean(scatter, &weights);
  result->stddev = 1 / std::sqrt(weights);
}

// Of each joint.
std::vector<JointProfile> Profiles(
    const TorqueFit& fit, const std::function<MatrixXd(double)>& torques,
    Eigen::Index joints) {
  constexpr int kDelays = 2 * kDelaySteps + 1;
  std::vector<MatrixXd> left(joints, MatrixXd(kDelays, kPieces));
  for (int k = 0; k < kDelays; ++k) {
    const MatrixXd tau = torques(DelayAt(k));
    const MatrixXd asked = fit.InMotion(tau);
    const MatrixXd squares =
        (asked - fit.Torque(fit.Parameters(tau))).cwiseAbs2();
    const Eigen::Index size = tau.rows();
    for (Eigen::Index j = 0; j < joints; ++j) {
      const double all = asked.col(j).squaredNorm() + 1e-18;
      for (int b = 0; b < kPieces; ++b) {
        const Eigen::Index begin = b * size / kPieces;
        const Eigen::Index end = (b + 1) * size / kPieces;
        left[j](k, b) = squares.col(j).segment(begin, end - begin).sum() / all;
      }
    }
  }
  return {left.begin(), left.end()};
}

// What the joints say of all pieces but two neighbours, or of all (-1).
TorqueDelay WithoutPieces(int first, const std::vector<JointProfile>& profiles,
                          const std::vector<bool>& asked) {
  std::vector<ToldDelay> told;
  for (size_t j = 0; j < asked.size(); ++j) {
    if (!asked[j]) continue;
    if (const auto one = profiles[j].Delay(first)) told.push_back(*one);
  }
  TorqueDelay result;
  result.joints = static_cast<int>(told.size());
  const auto of =
      static_cast<int>(std::count(asked.begin(), asked.end(), true));
  result.is_alone = of == 1;
  // Most of those asked have to tell one, of all pieces; without some of
  // them, as many as can agree.
  result.known = (result.is_alone ? result.joints == 1 : result.joints > 1) &&
                 (first >= 0 || 2 * result.joints > of);
  if (result.known) SetMeanOf(told, &result);
  return result;
}

}  // namespace

bool TorqueDelay::IsBeyond(double least) const {
  return known && std::abs(mean) - kOfInterval * stddev > least &&
         weakest > least;
}

TorqueDelay FindTorqueDelay(const TorqueFit& fit,
                            const std::function<MatrixXd(double)>& torques,
                            const std::vector<bool>& asked) {
  const auto profiles =
      Profiles(fit, torques, static_cast<Eigen::Index>(asked.size()));
  TorqueDelay result = WithoutPieces(-1, profiles, asked);
  const double side = result.mean < 0 ? -1 : 1;
  result.weakest = std::abs(result.mean);
  for (int b = 0; result.known && b + 1 < kPieces; ++b) {
    const TorqueDelay others = WithoutPieces(b, profiles, asked);
    result.known = others.known;
    result.weakest = std::min(result.weakest, side * others.mean);
  }
  return result;
}

}  // namespace armcal
