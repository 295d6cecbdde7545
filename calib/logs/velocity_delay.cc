#include "calib/logs/velocity_delay.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kStretch = .05;          // s
constexpr double kLeastLateness = .0125;  // s; filters and drives have less
constexpr double kAlike = .3;        // of both halves' delays, of their mean
constexpr double kMostLeft = .5;     // of squares, with and without a delay
constexpr int kParts = 8;            // every second one is a half
constexpr int kLeastStretches = 10;  // of a half

struct Stretches {
  MatrixXd columns;  // integral of qd, change of qd
  VectorXd change;   // of q
};

// Of half 0 or 1 of the log.
Stretches StretchesOf(const Log& log, int j, int half) {
  const double dt = (log.t[log.size() - 1] - log.t[0]) / (log.size() - 1);
  const int rows = std::max(1, static_cast<int>(std::lround(kStretch / dt)));
  const int count = (log.size() - 1) / rows;
  Stretches all{MatrixXd(count, 2), VectorXd(count)};
  int size = 0;
  for (int s = 0; s < count; ++s) {
    if (s * kParts / count % 2 != half) continue;
    const int begin = s * rows, end = begin + rows;
    double way = 0;
    for (int k = begin; k < end; ++k) {
      way += .5 * (log.qd(k, j) + log.qd(k + 1, j)) * (log.t[k + 1] - log.t[k]);
    }
    all.columns.row(size) << way, log.qd(end, j) - log.qd(begin, j);
    all.change[size++] = log.q(end, j) - log.q(begin, j);
  }
  return {all.columns.topRows(size), all.change.head(size)};
}

double Left(const Stretches& s, const Vector2d& law) {
  return (s.change - s.columns * law).squaredNorm();
}

}  // namespace

std::optional<double> VelocityDelay(const Log& log, int j) {
  const Stretches halves[] = {StretchesOf(log, j, 0), StretchesOf(log, j, 1)};
  double delays[2];
  for (int half = 0; half < 2; ++half) {
    const Stretches &seen = halves[half], &unseen = halves[1 - half];
    const double square = seen.columns.col(0).squaredNorm();
    if (seen.change.size() < kLeastStretches || !(square > 0)) return {};
    const Vector2d gain(seen.columns.col(0).dot(seen.change) / square, 0);
    const Vector2d law = seen.columns.colPivHouseholderQr().solve(seen.change);
    if (!(Left(unseen, law) < kMostLeft * Left(unseen, gain))) return {};
    delays[half] = law[1] / law[0];
  }
  const double mean = .5 * (delays[0] + delays[1]);
  if (!(std::abs(mean) > kLeastLateness)) return {};
  if (std::abs(delays[0] - delays[1]) > kAlike * std::abs(mean)) return {};
  return mean;
}

}  // namespace armcal
