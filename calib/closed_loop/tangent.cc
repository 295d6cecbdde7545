#include "calib/closed_loop/tangent.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "model/dynamics/drive_filters.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

constexpr long kPeriodsAtOnce = 64;  // linearised at once

// Derivatives of everything by all columns, carried forwards along the
// simulation (forward sensitivities): they cost a few simulations whatever the
// number of columns, and they are exact where differences of simulations would
// need a step between rounding and curvature. The arm's part, d(q, qd) over a
// period, is MotionTangent's; the drives' lines are those of
// LoopNoiseCovariance.
class Linearisation {
 public:
  Linearisation(const ControllerOptions& controller, const LoopValues& values,
                const LoopColumns& columns, const LoopStretch& stretch,
                const LoopTrack& track)
      : values_(values),
        columns_(columns),
        stretch_(stretch),
        track_(track),
        n_(static_cast<int>(values.drives.size())),
        period_(stretch.period()),
        decay_(LowPassDecay(controller.velocity_filter_hz, controller.rate_hz)),
        tangent_(values.arm, columns.arm()) {
    state_ = TangentRows(2 * n_, columns.size());
    last_ = velocity_ = integral_ = behind_ = command_ = torque_ =
        TangentRows(n_, columns.size());
    unit_torque_ = TangentRows(n_, 3 * n_);
    for (int j = 0; j < n_; ++j) {
      const int q0 = columns.start() + j, qd0 = q0 + n_;
      state_(j, q0) = state_(n_ + j, qd0) = 1;
      last_(j, q0) = 1;
      last_(j, qd0) = -period_;
      velocity_(j, qd0) = 1;
      integral_(j, qd0 + n_) = 1;
      unit_torque_(j, 2 * n_ + j) = 1;
    }
    if (std::any_of(values.drives.begin(), values.drives.end(),
                    [](const DriveLaw& drive) { return drive.lag > 0; })) {
      SetLags();
    }
  }

  LoopTangent Run(bool want_periods) {
    LoopTangent result;
    result.by_columns.resize(n_ * stretch_.num_rows(), columns_.size());
    const long periods = stretch_.num_periods();
    for (long first = 0; first < periods; first += kPeriodsAtOnce) {
      const long count = std::min(kPeriodsAtOnce, periods - first);
      tangent_.Linearise(track_.q, track_.qd, first, count, period_);
      for (long k = first; k < first + count; ++k) {
        Advance(k, k - first, &result.by_columns);
        if (want_periods) result.periods.push_back(Period(k - first));
      }
    }
    return result;
  }

 private:
  void SetLags() {
    lags_.emplace();
    for (const DriveLaw& drive : values_.drives) {
      lags_->emplace_back(drive.lag, period_);
    }
  }
  void Control(long k);
  void AddGains(long k);
  void Lag(long k);
  void Advance(long k, long at, MatrixXd* by_columns);
  MatrixXd Period(long at) const;

  const LoopValues& values_;
  const LoopColumns& columns_;
  const LoopStretch& stretch_;
  const LoopTrack& track_;
  int n_;
  double period_, decay_;
  MotionTangent tangent_;
  std::optional<std::vector<LagShares>> lags_;  // nothing: no drive has one
  long row_ = 0;
  // Derivatives: of (q, qd), of what the drives keep, of the commanded torque
  // and of the period's mean.
  TangentRows state_, before_, last_, velocity_, integral_, behind_, command_,
      torque_, unit_torque_;
};

// Derivatives of the drives' commands and integrals by all that they saw
// before.
void Linearisation::Control(long k) {
  const double rate = (1 - decay_) / period_;
  const long size = state_.stride();
  for (int j = 0; j < n_; ++j) {
    const DriveSlopes& slopes = track_.slopes[n_ * k + j];
    const auto row = [size, j](TangentRows* rows) {
      return Eigen::Map<Eigen::ArrayXd>(rows->row(j), size);
    };
    const auto q = row(&state_);
    auto last = row(&last_), velocity = row(&velocity_),
         integral = row(&integral_), command = row(&command_);
    velocity = decay_ * velocity + rate * (q - last);
    command =
        slopes.acts * (integral - slopes.by_q * q - slopes.by_v * velocity);
    integral -= slopes.integrates * period_ *
                (slopes.rate_by_q * q + slopes.rate_by_v * velocity);
    last = q;
  }
  AddGains(k);
}

// Adds the derivatives by the drives' own gains, command = kp error + kd w + ki
// integral, and by the command's delay: a command that comes later by d is
// q_ref - d qd_ref.
void Linearisation::AddGains(long k) {
  for (const LoopColumns::Gain& gain : columns_.gains()) {
    const int j = gain.joint;
    const DriveSlopes& slopes = track_.slopes[n_ * k + j];
    const DriveLaw& law = values_.drives[j];
    const double error = track_.error(k, j), w = track_.velocity_error(k, j);
    const double follows = slopes.follows * error;
    double torque = 0, rate = 0;
    if (gain.gain == &DriveLaw::kp) torque = error;
    if (gain.gain == &DriveLaw::kd) torque = w;
    if (gain.gain == &DriveLaw::ki) rate = error;
    if (gain.gain == &DriveLaw::velocity_ki) rate = w;
    if (gain.gain == &DriveLaw::position_gain) {
      torque = law.kd * follows;
      rate = law.velocity_ki * follows;
    }
    command_(j, gain.column) += slopes.acts * torque;
    integral_(j, gain.column) += slopes.integrates * period_ * rate;
  }
  const int delay = columns_.delay();
  const ReferenceSeries& at = track_.reference;
  for (int j = 0; j < n_ && delay >= 0; ++j) {
    const DriveSlopes& slopes = track_.slopes[n_ * k + j];
    const double feedforward =
        slopes.follows * values_.drives[j].velocity_feedforward * at.qdd(k, j);
    command_(j, delay) -=
        slopes.acts * (slopes.by_q * at.qd(k, j) + slopes.by_v * feedforward +
                       at.feedforward_rate(k, j));
    integral_(j, delay) -=
        slopes.integrates * period_ *
        (slopes.rate_by_q * at.qd(k, j) + slopes.rate_by_v * feedforward);
  }
}

// Derivatives of the torque's mean, from those of the commands; `behind_` holds
// the torque at the begin. For a first-order lag both are shares of how far the
// torque was behind.
void Linearisation::Lag(long k) {
  const long size = state_.stride();
  if (!lags_) {
    std::swap(torque_, command_);  // what was there is written anew
    return;
  }
  for (int j = 0; j < n_; ++j) {
    const LagShares& lag = (*lags_)[j];
    const double* const command = command_.row(j);
    double *const torque = behind_.row(j), *const mean = torque_.row(j);
    for (long c = 0; c < size; ++c) {
      const double behind = k == 0 ? 0 : torque[c] - command[c];
      mean[c] = command[c] + lag.mean * behind;
      torque[c] = command[c] + lag.end * behind;
    }
  }
  for (const LoopColumns::Gain& gain : columns_.gains()) {
    if (gain.gain != &DriveLaw::lag) continue;
    const LagShares& lag = (*lags_)[gain.joint];
    const double behind = track_.behind(k, gain.joint);
    torque_(gain.joint, gain.column) += lag.mean_by_lag * behind;
    behind_(gain.joint, gain.column) += lag.end_by_lag * behind;
  }
}

// One period, and the rows of the log that lie in it: a row's position is a
// Hermite cubic of the states at both ends, and so are its derivatives.
void Linearisation::Advance(long k, long at, MatrixXd* by_columns) {
  const auto has_row = [&] {
    return row_ < stretch_.num_rows() && stretch_.period_of(row_) == k;
  };
  Control(k);
  Lag(k);
  if (has_row()) before_ = state_;
  tangent_.Advance(at, torque_, true, &state_);
  for (; has_row(); ++row_) {
    const RowWeights w(stretch_.share_of(row_), period_);
    for (int j = 0; j < n_; ++j) {
      const double *q0 = before_.row(j), *qd0 = before_.row(n_ + j);
      const double *q1 = state_.row(j), *qd1 = state_.row(n_ + j);
      for (int c = 0; c < columns_.size(); ++c) {
        (*by_columns)(n_ * row_ + j, c) =
            w.q0 * q0[c] + w.qd0 * qd0[c] + w.q1 * q1[c] + w.qd1 * qd1[c];
      }
    }
  }
}

MatrixXd Linearisation::Period(long at) const {
  TangentRows state(2 * n_, 3 * n_);
  for (int r = 0; r < 2 * n_; ++r) state(r, r) = 1;
  tangent_.Advance(at, unit_torque_, false, &state);
  MatrixXd step(2 * n_, 3 * n_);
  for (int r = 0; r < 2 * n_; ++r) {
    for (int c = 0; c < 3 * n_; ++c) step(r, c) = state(r, c);
  }
  return step;
}

}  // namespace

LoopTangent LineariseLoop(const ControllerOptions& controller,
                          const LoopValues& values, const LoopColumns& columns,
                          const LoopStretch& stretch, const LoopTrack& track,
                          bool want_periods) {
  return Linearisation(controller, values, columns, stretch, track)
      .Run(want_periods);
}

}  // namespace armcal
