#include "calib/loop_noise.h"

#include <cmath>

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

MatrixXd LoopNoiseCovariance(const ControllerOptions& controller,
                             const LoopValues& values, const LoopRun& run,
                             const VectorXd& noise, const MatrixXd& weights) {
  const auto n = static_cast<int>(noise.size());
  const double period = 1 / controller.rate_hz;
  const double decay =
      std::exp(-2 * M_PI * controller.velocity_filter_hz * period);
  const double rate = (1 - decay) / period;
  // How the sum of weighted residuals from here on changes with the state:
  // q and qd, 2 n rows; the last position seen; the controller's velocity; its
  // integral.
  MatrixXd by_state = MatrixXd::Zero(2 * n, weights.cols());
  MatrixXd by_last = by_state.topRows(n), by_velocity = by_last,
           by_integral = by_last, at_begin = by_state,
           back(3 * n, weights.cols());
  Squares squares(weights.cols());
  Eigen::RowVectorXd by_noise(weights.cols());
  long row = static_cast<long>(run.period_of_row.size()) - 1;
  for (long k = static_cast<long>(run.periods.size()) - 1; k >= 0; --k) {
    const LoopPeriod& at = run.periods[k];
    at_begin.setZero();
    MatrixXd seen = MatrixXd::Zero(n, weights.cols());
    for (; row >= 0 && run.period_of_row[row] == k; --row) {
      const double share = run.share_of_row[row];
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
    back.noalias() = at.step.transpose() * by_state;
    for (int j = 0; j < n; ++j) {
      const Eigen::RowVectorXd by_torque = at.acts[j] * back.row(2 * n + j);
      const Eigen::RowVectorXd velocity =
          by_velocity.row(j) - values.kd[j] * by_torque;
      // By the position that the controller sees now.
      const Eigen::RowVectorXd position =
          by_last.row(j) - values.kp[j] * by_torque + rate * velocity -
          at.integrates[j] * values.ki[j] * period * by_integral.row(j);
      by_last.row(j) = -rate * velocity;
      by_velocity.row(j) = decay * velocity;
      by_integral.row(j) += by_torque;
      back.row(j) += position;
      by_noise = noise[j] * (position + seen.row(j));
      squares.Add(by_noise);
    }
    by_state = back.topRows(2 * n) + at_begin;
  }
  return squares.Sum();
}

}  // namespace armcal
