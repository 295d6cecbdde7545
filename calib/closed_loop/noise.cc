#include "calib/closed_loop/noise.h"

#include <vector>

#include "model/dynamics/drive_filters.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Adds up X'X of rows that come one after the other.
class Squares {
 public:
  explicit Squares(long columns)
      : rows_(kRows, columns), sum_(MatrixXd::Zero(columns, columns)) {}
  template <class Row>
  void Add(const Row& row) {
    rows_.row(filled_++) = row;
    if (filled_ == kRows) Flush();
  }
  const MatrixXd& Sum() {
    Flush();
    return sum_;
  }

 private:
  static constexpr int kRows = 256;
  void Flush() {
    sum_.noalias() +=
        rows_.topRows(filled_).transpose() * rows_.topRows(filled_);
    filled_ = 0;
  }
  MatrixXd rows_, sum_;
  int filled_ = 0;
};

}  // namespace

// The loop is linear about its track, so that a sum f of weighted residuals is
// a sum over joints and periods of c_k e_k, with e_k the noise of the position
// that the controller sees in period k. Noise is white: the covariance of
// several such sums is sum_k noise^2 c_k c_k'. The c_k = df/de_k of all periods
// come from one pass backwards (reverse differentiation; Griewank & Walther
// 2008, Evaluating Derivatives, ch. 3); forwards, each e_k would need a
// simulation of its own.
//
// For a joint, with x = (q, qd) of the arm, l the position seen last, v the
// controller's velocity, i its integral and b the torque behind the lag, a
// period is
//   p = q + e                            what the controller sees
//   v <- decay v + rate (p - l),  l <- p
//   u = acts (i - by_q p - by_v v)       the command
//   i <- i - integrates period (rate_by_q p + rate_by_v v)
//   m = (1 - lag.mean) u + lag.mean b    the period's mean torque
//   b <- (1 - lag.end) u + lag.end b
//   x <- A_k (x, m).
// The df/dstate behind a period become those before it by the transpose of each
// line, the last line first. Then c_k = df/dp, and the weight of the row that
// logged p itself, if one did: measured minus simulated has e as it is. A row
// within a period has noise of its own, which no controller saw.
MatrixXd LoopNoiseCovariance(const ControllerOptions& controller,
                             const LoopValues& values,
                             const LoopStretch& stretch, const LoopTrack& track,
                             const std::vector<MatrixXd>& periods,
                             const VectorXd& noise, const MatrixXd& weights) {
  const auto n = static_cast<int>(noise.size());
  const double period = stretch.period();
  const double decay =
      LowPassDecay(controller.velocity_filter_hz, controller.rate_hz);
  const double rate = (1 - decay) / period;
  std::vector<LagShares> lags;
  for (const DriveLaw& drive : values.drives) {
    lags.emplace_back(drive.lag, period);
  }
  // How the sum of weighted residuals from here on changes with the state:
  // q and qd, 2 n rows; the last position seen; the controller's velocity; its
  // integral; the torque behind the lag.
  MatrixXd by_state = MatrixXd::Zero(2 * n, weights.cols());
  MatrixXd by_last = by_state.topRows(n), by_velocity = by_last,
           by_integral = by_last, by_lagging = by_last, at_begin = by_state,
           back(3 * n, weights.cols());
  Squares squares(weights.cols());
  using Row = Eigen::RowVectorXd;
  Row by_noise(weights.cols());
  long row = stretch.num_rows() - 1;
  for (long k = static_cast<long>(periods.size()) - 1; k >= 0; --k) {
    at_begin.setZero();
    MatrixXd seen = MatrixXd::Zero(n, weights.cols());
    for (; row >= 0 && stretch.period_of(row) == k; --row) {
      const double share = stretch.share_of(row);
      const RowWeights w(share, period);
      const auto of_row = weights.middleRows(n * row, n);
      at_begin.topRows(n) += w.q0 * of_row;
      at_begin.bottomRows(n) += w.qd0 * of_row;
      if (share == 0) {  // the controller sees what is measured
        seen += of_row;
        continue;
      }
      by_state.topRows(n) += w.q1 * of_row;
      by_state.bottomRows(n) += w.qd1 * of_row;
      for (int j = 0; j < n; ++j) squares.Add(noise[j] * of_row.row(j));
    }
    back.noalias() = periods[k].transpose() * by_state;
    for (int j = 0; j < n; ++j) {
      const DriveSlopes& at = track.slopes[n * k + j];
      const LagShares& lag = lags[j];
      const Row by_mean = back.row(2 * n + j);
      const Row by_command = at.acts * ((1 - lag.mean) * by_mean +
                                        (1 - lag.end) * by_lagging.row(j));
      by_lagging.row(j) = lag.mean * by_mean + lag.end * by_lagging.row(j);
      const Row by_rate = at.integrates * period * by_integral.row(j);
      const Row velocity =
          by_velocity.row(j) - at.by_v * by_command - at.rate_by_v * by_rate;
      // By the position that the controller sees now.
      const Row position = by_last.row(j) - at.by_q * by_command +
                           rate * velocity - at.rate_by_q * by_rate;
      by_last.row(j) = -rate * velocity;
      by_velocity.row(j) = decay * velocity;
      by_integral.row(j) += by_command;
      back.row(j) += position;
      by_noise = noise[j] * (position + seen.row(j));
      squares.Add(by_noise);
    }
    by_state = back.topRows(2 * n) + at_begin;
  }
  return squares.Sum();
}

}  // namespace armcal
