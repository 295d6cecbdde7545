#include "calib/logs/encoder_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "calib/logs/position_noise.h"
#include "calib/logs/recorded_logs.h"
#include "model/signals/position_spikes.h"

namespace armcal {
namespace {

using Eigen::ArrayXd;

// As many as the noise of torques is told from (EstimateSampleNoise): the
// median of 60000 is known to a percent.
constexpr long kMostSamples = 60000;

// Times and positions of a log's first samples within the crop, and the largest
// torques.
struct RecordedPositions {
  std::vector<double> t;
  Eigen::MatrixXd q;      // samples x n
  Eigen::ArrayXd torque;  // n, or none
};

RecordedPositions ReadPositions(const TimeRange& crop, long most,
                                KeptLog* rows) {
  RecordedPositions read;
  std::vector<double> values;  // row after row
  Eigen::Index n = 0;
  const long limit = std::max(8L, most);
  while (const Log* block = rows->Next()) {
    n = block->q.cols();
    if (block->tau.rows() > 0) {
      const ArrayXd most =
          block->tau.cwiseAbs().colwise().maxCoeff().transpose().array();
      read.torque =
          read.torque.size() > 0 ? read.torque.max(most).eval() : most;
    }
    for (Eigen::Index k = 0; k < block->q.rows(); ++k) {
      const double t = block->t[k];
      if (t < crop.begin || static_cast<long>(read.t.size()) >= limit) continue;
      if (t > crop.end) break;
      if (!read.t.empty() && t <= read.t.back()) continue;
      read.t.push_back(t);
      for (Eigen::Index j = 0; j < n; ++j) values.push_back(block->q(k, j));
    }
    if (static_cast<long>(read.t.size()) >= limit) break;
  }
  using RowMajor =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  read.q = Eigen::Map<const RowMajor>(
      values.data(), static_cast<Eigen::Index>(read.t.size()), n);
  // One row in which a joint is elsewhere has a larger second difference than
  // all others together, and would be the noise of them all.
  const Eigen::Map<const Eigen::VectorXd> t(read.t.data(), read.q.rows());
  for (Eigen::Index j = 0; j < n; ++j) RemovePositionSpikes(t, read.q.col(j));
  return read;
}

// The mean square of (q(t + h) - 2 q(t) + q(t - h)) / h^2 with h = lag steps of
// dt, less 6 variance / h^4, which is what white noise makes of it. Differences
// across gaps are left out.
ArrayXd MeanSquareAcceleration(const RecordedPositions& read, double dt,
                               int lag, const ArrayXd& variance) {
  const double h = lag * dt;
  ArrayXd sum = ArrayXd::Zero(read.q.cols());
  long count = 0;
  const long size = static_cast<long>(read.t.size());
  for (long k = lag; k + lag < size; ++k) {
    if (read.t[k + lag] - read.t[k - lag] > 3 * h) continue;
    const auto bend =
        read.q.row(k + lag) - 2 * read.q.row(k) + read.q.row(k - lag);
    sum += bend.transpose().array().square();
    ++count;
  }
  if (count == 0) return sum;
  const double to_rate = 1 / (h * h * h * h);
  return ((sum / count - 6 * variance) * to_rate).max(0);
}

constexpr double kSlow = .1;  // of the samples in which a joint moves

// Sums over logs, weighted by the seconds that were read.
struct Sums {
  ArrayXd density, slow_density, acceleration, low, high, torque;
  double seconds = 0;

  void Add(const RecordedPositions& read, double dt, double bandwidth_hz) {
    const Eigen::Index n = read.q.cols();
    if (seconds == 0) {
      density = slow_density = acceleration = ArrayXd::Zero(n);
      low = ArrayXd::Constant(n, std::numeric_limits<double>::infinity());
      high = -low;
    }
    const Eigen::ArrayXXd variances =
        PositionNoise(read.q, {1, kSlow}).array().square();
    const ArrayXd variance = variances.col(0);
    const int lag =
        std::max(1, static_cast<int>(std::lround(1 / (4 * bandwidth_hz * dt))));
    const double length = static_cast<double>(read.t.size()) * dt;
    density += length * dt * variance;
    slow_density += length * dt * variances.col(1);
    acceleration += length * MeanSquareAcceleration(read, dt, lag, variance);
    low = low.min(read.q.colwise().minCoeff().transpose().array());
    high = high.max(read.q.colwise().maxCoeff().transpose().array());
    if (read.torque.size() > 0) {
      torque = torque.size() > 0 ? torque.max(read.torque).eval() : read.torque;
    }
    seconds += length;
  }
};

}  // namespace

EncoderNoise MeasureEncoderNoise(const LogSet& logs, double bandwidth_hz) {
  RecordedLogs& recorded = *logs.recorded_;
  const std::lock_guard<std::mutex> lock(recorded.pass);
  std::shared_ptr<const EncoderNoise>& known =
      recorded.encoder_noise[bandwidth_hz];
  if (known != nullptr) return *known;
  Sums sums;
  for (int log = 0; log < logs.size(); ++log) {
    const RecordedPositions read = ReadPositions(
        recorded.crop, kMostSamples / logs.size(), recorded.Rows(log, false));
    if (read.q.rows() == 0) continue;
    sums.Add(read, logs.time_bases()[log].dt, bandwidth_hz);
  }
  EncoderNoise noise;
  if (sums.seconds > 0) {
    noise = {sums.density / sums.seconds, sums.slow_density / sums.seconds,
             sums.acceleration / sums.seconds, sums.high - sums.low,
             sums.torque};
  }
  known = std::make_shared<const EncoderNoise>(noise);
  return noise;
}

}  // namespace armcal
