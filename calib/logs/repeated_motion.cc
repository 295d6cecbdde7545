#include "calib/logs/repeated_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armcal {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSearchStep = 0.05;     // s, of the search
constexpr double kShortestStretch = 2;   // s
constexpr double kTolerance = 0.01;      // of a joint's rms motion
constexpr double kPositionNoise = 5e-4;  // rad or m: encoders, tracking
constexpr double kLeastMotion = 0.02;    // rad or m, rms
constexpr double kLeastActivity = 0.25;  // of the mean square speed

// On the grid of the search, linear between samples: where a fast joint was at
// the nearest sample differs by more than a repeat does.
MatrixXd EverySteps(const RecordedMotion& motion) {
  const double length = motion.t[motion.t.size() - 1] - motion.t[0];
  MatrixXd q(static_cast<Index>(length / kSearchStep) + 1, motion.q.cols());
  Index at = 0;
  for (Index k = 0; k < q.rows(); ++k) {
    const double t = motion.t[0] + static_cast<double>(k) * kSearchStep;
    while (at + 2 < motion.t.size() && motion.t[at + 1] <= t) ++at;
    const double step = motion.t[at + 1] - motion.t[at];
    const double share = step > 0 ? (t - motion.t[at]) / step : 0;
    q.row(k) = (1 - share) * motion.q.row(at) + share * motion.q.row(at + 1);
  }
  return q;
}

ArrayXd MeanSquareStep(const MatrixXd& q) {
  const Index n = q.rows() - 1;
  return (q.bottomRows(n) - q.topRows(n)).colwise().squaredNorm().array() /
         static_cast<double>(n);
}

// One motion on the grid of the search against another.
class Comparison {
 public:
  Comparison(const RecordedMotion& earlier, const RecordedMotion& later)
      : earlier_(earlier),
        later_(later),
        a_(EverySteps(earlier)),
        b_(EverySteps(later)) {
    if (a_.rows() < 2) return;
    const MatrixXd about = a_.rowwise() - a_.colwise().mean();
    const ArrayXd motion =
        (about.colwise().squaredNorm().array() / static_cast<double>(a_.rows()))
            .sqrt();
    moves_ = motion.maxCoeff() > kLeastMotion;
    activity_ = MeanSquareStep(a_);
    tolerance_ = kTolerance * motion + kPositionNoise;
  }
  bool moves() const { return moves_; }

  std::optional<double> Find(double least_lag) const {
    const Index shortest = static_cast<Index>(kShortestStretch / kSearchStep);
    const double offset = later_.t[0] - earlier_.t[0];
    const Index last = b_.rows() - shortest;
    // The least lag may be infinite.
    const double first =
        std::max(std::min(std::ceil((least_lag - offset) / kSearchStep),
                          static_cast<double>(last + 1)),
                 static_cast<double>(shortest - a_.rows()));
    for (Index lag = static_cast<Index>(first); lag <= last; ++lag) {
      if (!MayRepeat(lag)) continue;
      const auto fine = Refine(offset + static_cast<double>(lag) * kSearchStep);
      if (fine && *fine >= least_lag) return fine;
    }
    return std::nullopt;
  }

 private:
  // As far as positions half a step off can tell.
  bool MayRepeat(Index lag) const {
    const Index begin = std::max<Index>(0, -lag);
    const Index count = std::min(a_.rows(), b_.rows() - lag) - begin;
    const ArrayXd allowed = tolerance_ + 0.6 * activity_.sqrt();
    const ArrayXd limit = static_cast<double>(count) * allowed.square();
    ArrayXd sum = ArrayXd::Zero(a_.cols());
    for (Index k = begin; k < begin + count; ++k) {
      sum += (b_.row(k + lag) - a_.row(k)).array().square().transpose();
      if ((sum > limit).any()) return false;
    }
    return MeanSquareStep(a_.middleRows(begin, count)).sum() >
           kLeastActivity * activity_.sum();
  }

  // The best lag about this one, if it is good enough.
  std::optional<double> Refine(double about) const {
    const double dt = (earlier_.t[earlier_.t.size() - 1] - earlier_.t[0]) /
                      static_cast<double>(earlier_.t.size() - 1);
    double best = std::numeric_limits<double>::infinity(), at = about;
    for (double lag = about - kSearchStep; lag <= about + kSearchStep;
         lag += dt / 2) {
      const double excess = (Difference(lag) / tolerance_).maxCoeff();
      if (excess < best) best = excess, at = lag;
    }
    if (best > 1) return std::nullopt;
    return at;
  }

  // rms over the time that both are known.
  ArrayXd Difference(double lag) const {
    ArrayXd sum = ArrayXd::Zero(a_.cols());
    double count = 0;
    const Index stride = std::max<Index>(1, a_.rows() / 500);
    for (Index k = 0; k < a_.rows(); k += stride) {
      const Index from = NearestSample(
          earlier_.t, earlier_.t[0] + static_cast<double>(k) * kSearchStep);
      const double t = earlier_.t[from] + lag;
      if (t < later_.t[0] || t > later_.t[later_.t.size() - 1]) continue;
      const Index right = std::clamp<Index>(
          std::lower_bound(later_.t.begin(), later_.t.end(), t) -
              later_.t.begin(),
          1, later_.t.size() - 1);
      const double share =
          (t - later_.t[right - 1]) / (later_.t[right] - later_.t[right - 1]);
      sum += ((1 - share) * later_.q.row(right - 1) +
              share * later_.q.row(right) - earlier_.q.row(from))
                 .array()
                 .square()
                 .transpose();
      ++count;
    }
    return (sum / std::max(1.0, count)).sqrt();
  }

  const RecordedMotion& earlier_;
  const RecordedMotion& later_;
  MatrixXd a_, b_;
  bool moves_ = false;
  ArrayXd activity_, tolerance_;
};

}  // namespace

Index NearestSample(const VectorXd& t, double time) {
  const Index right = std::lower_bound(t.begin(), t.end(), time) - t.begin();
  if (right == 0) return 0;
  if (right == t.size()) return t.size() - 1;
  return time - t[right - 1] < t[right] - time ? right - 1 : right;
}

std::optional<double> FindRepeat(const RecordedMotion& earlier,
                                 const RecordedMotion& later,
                                 double least_lag) {
  if (earlier.t.size() < 3 || later.t.size() < 3) return std::nullopt;
  const Comparison comparison(earlier, later);
  if (!comparison.moves()) return std::nullopt;
  return comparison.Find(least_lag);
}

}  // namespace armcal
