#include "calib/closed_loop/stretch.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

RowWeights::RowWeights(double share, double period) {
  const double s = share, r = 1 - s;
  q0 = r * r * (1 + 2 * s);
  q1 = s * s * (1 + 2 * r);
  qd0 = r * r * s * period;
  qd1 = -s * s * r * period;
}

// Rows within 1e-6 of a period's border are at it: stamps are rounded, and a
// row at the border is what the controller saw there.
LoopStretch::LoopStretch(const Log& log, const CommandedReference& command,
                         long first_row, long num_rows, double period)
    : log_(log),
      command_(command),
      first_row_(first_row),
      period_(period),
      near_delay_(std::numeric_limits<double>::infinity()) {
  constexpr double kAtBorder = 1e-6;  // of a period
  CHECK_LE(first_row + num_rows, log.size());
  for (long k = 0; k < num_rows; ++k) {
    const double at = (log.t[first_row + k] - log.t[first_row]) / period;
    const double nearest = std::round(at);
    const bool is_border = std::abs(at - nearest) < kAtBorder;
    const double begin = is_border ? nearest : std::floor(at);
    period_of_row_.push_back(static_cast<long>(begin));
    share_of_row_.push_back(is_border ? 0 : at - begin);
  }
}

ReferenceSeries LoopStretch::Reference(double delay) const {
  constexpr double kNear = 1e-4;  // s, where a parabola is exact
  if (!(std::abs(delay - near_delay_) < kNear)) {
    near_ = command_.At(log_.t[first_row_], period_, num_periods(), delay);
    near_delay_ = delay;
  }
  const double later = delay - near_delay_;
  if (later == 0) return near_;
  ReferenceSeries at = near_;
  at.q += -later * near_.qd + later * later / 2 * near_.qdd;
  at.qd -= later * near_.qdd;
  at.feedforward -= later * near_.feedforward_rate;
  return at;
}

// Position and velocity by a line through the first rows (least squares): two
// rows would make a velocity of their noise.
LoopStart LoopStretch::Start() const {
  // A line through the first hundredth of a second, or four rows.
  constexpr double kSeconds = .01;
  long count = 4;
  while (first_row_ + count < log_.size() &&
         log_.t[first_row_ + count] < log_.t[first_row_] + kSeconds) {
    ++count;
  }
  count = std::min<long>(count, log_.size() - first_row_);
  const Eigen::ArrayXd t =
      log_.t.segment(first_row_, count).array() - log_.t[first_row_];
  const MatrixXd q = log_.q.middleRows(first_row_, count);
  const Eigen::ArrayXd centred = t - t.mean();
  LoopStart start;
  start.qd = q.transpose() * centred.matrix() / centred.square().sum();
  start.q = q.colwise().mean().transpose() - t.mean() * start.qd;
  start.integral = VectorXd::Zero(q.cols());
  return start;
}

}  // namespace armcal
