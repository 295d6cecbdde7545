#include "calib/position_loop.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr long kPeriodsPerBlock = 32;  // linearised at once
constexpr int kMostSubsteps = 32;
// Times StageStepper::SafeStep(): where explicit steps are still stable.
constexpr double kStable = 3;

// What the controller did in one period, for its derivatives.
struct Action {
  VectorXd error, velocity_error;  // n
  Eigen::ArrayXd acts, integrates;
};

class Simulation {
 public:
  Simulation(const ControllerOptions& controller, const LoopValues& values,
             const LoopStart& start, const ReferenceSeries& reference,
             PositionLoop::Wanted wanted)
      : options_(controller),
        values_(values),
        reference_(reference),
        n_(static_cast<int>(start.q.size())),
        columns_(n_),
        tangents_(wanted != PositionLoop::Wanted::kResidual),
        periods_(wanted == PositionLoop::Wanted::kPeriods),
        period_(1 / controller.rate_hz),
        decay_(std::exp(-2 * M_PI * controller.velocity_filter_hz * period_)),
        stepper_(values.arm),
        tangent_(values.arm),
        last_(start.q - period_ * start.qd),
        velocity_(start.qd),
        integral_(start.integral),
        velocity_feedforward_(n_),
        torque_(n_, 3),
        actions_(kPeriodsPerBlock) {
    for (int j = 0; j < n_; ++j) {
      velocity_feedforward_[j] = controller.drives[j].velocity_feedforward;
    }
    stepper_.SetState(start.q, start.qd);
    substeps_ = std::clamp(
        static_cast<int>(
            std::ceil(period_ / (kStable * stepper_.SafeStep(start.q)))),
        values.substeps, kMostSubsteps);
    if (!tangents_) return;
    motion_.Resize(kPeriodsPerBlock * substeps_, n_);
    const int size = columns_.size();
    state_ = TangentRows(2 * n_, size);
    last_rows_ = velocity_rows_ = integral_rows_ = torque_rows_ =
        TangentRows(n_, size);
    for (int j = 0; j < n_; ++j) {
      const int q0 = columns_.start() + j, qd0 = q0 + n_;
      state_(j, q0) = state_(n_ + j, qd0) = 1;
      last_rows_(j, q0) = 1;
      last_rows_(j, qd0) = -period_;
      velocity_rows_(j, qd0) = 1;
      integral_rows_(j, qd0 + n_) = 1;
    }
    unit_torque_ = TangentRows(n_, 3 * n_);
    for (int j = 0; j < n_; ++j) unit_torque_(j, 2 * n_ + j) = 1;
  }

  // `rows`: of the log, as shares of periods from the begin.
  LoopRun Run(const VectorXd& rows, const MatrixXd& measured, long first_row) {
    LoopRun run;
    const long count = rows.size();
    run.residual.resize(n_ * count);
    if (tangents_ && !periods_)
      run.by_values.resize(n_ * count, columns_.size());
    run.torque_squares = VectorXd::Zero(n_);
    for (long k = 0; k < count; ++k) {
      const double nearest = std::round(rows[k]);
      const bool at = std::abs(rows[k] - nearest) < 1e-6;
      run.period_of_row.push_back(
          static_cast<long>(at ? nearest : std::floor(rows[k])));
      run.share_of_row.push_back(
          at ? 0 : rows[k] - static_cast<double>(run.period_of_row[k]));
    }
    const long periods = run.period_of_row.back() + 1;
    long row = 0, tangent_row = 0;
    for (long first = 0; first < periods; first += kPeriodsPerBlock) {
      const long size = std::min(kPeriodsPerBlock, periods - first);
      for (long k = 0; k < size; ++k) {
        const VectorXd q = stepper_.q(), qd = stepper_.qd();
        if (!Advance(first, k, &run)) {
          run.finite = false;
          return run;
        }
        for (; row < count && run.period_of_row[row] == first + k; ++row) {
          const RowWeights w(run.share_of_row[row], period_);
          run.residual.segment(n_ * row, n_) =
              measured.row(first_row + row).transpose() - w.q0 * q -
              w.qd0 * qd - w.q1 * stepper_.q() - w.qd1 * stepper_.qd();
        }
      }
      if (!tangents_) continue;
      tangent_.Linearise(motion_, size * substeps_);
      for (long k = 0; k < size; ++k) {
        if (periods_) {
          AddPeriod(k, &run);
        } else {
          AdvanceTangents(first, k, &tangent_row, &run);
        }
      }
    }
    return run;
  }

 private:
  // One control period; false where the arm is lost.
  bool Advance(long first, long k, LoopRun* run) {
    const VectorXd& q = stepper_.q();
    velocity_ = decay_ * velocity_ + (1 - decay_) / period_ * (q - last_);
    last_ = q;
    Action& action = actions_[k];
    action.error = reference_.q.row(first + k).transpose() - q;
    action.velocity_error = velocity_feedforward_.cwiseProduct(
                                reference_.qd.row(first + k).transpose()) -
                            velocity_;
    VectorXd torque = reference_.feedforward.row(first + k).transpose() +
                      values_.kp.cwiseProduct(action.error) +
                      values_.kd.cwiseProduct(action.velocity_error) +
                      integral_;
    action.acts = action.integrates = Eigen::ArrayXd::Ones(n_);
    for (int j = 0; j < n_; ++j) {
      const double limit = options_.drives[j].torque_limit;
      if (std::abs(torque[j]) >= limit) {
        action.acts[j] = 0;
        action.integrates[j] = torque[j] * action.error[j] > 0 ? 0 : 1;
      }
      integral_[j] +=
          action.integrates[j] * values_.ki[j] * period_ * action.error[j];
      torque[j] = std::clamp(torque[j], -limit, limit);
    }
    run->torque_squares += torque.cwiseAbs2();
    torque_.colwise() = torque;
    StageMotion* const kept = tangents_ ? &motion_ : nullptr;
    for (int i = 0; i < substeps_; ++i) {
      const long at = StageMotion::kStages * (k * substeps_ + i);
      if (!stepper_.Advance(period_ / substeps_, torque_, at, kept)) {
        return false;
      }
    }
    return true;
  }

  void Step(long k, const TangentRows& torque, bool by_parameters,
            TangentRows* state) const {
    const TangentRows* const same[] = {&torque, &torque, &torque};
    for (int i = 0; i < substeps_; ++i) {
      tangent_.Advance(k * substeps_ + i, period_ / substeps_, same,
                       by_parameters, state);
    }
  }

  void AddPeriod(long k, LoopRun* run) const {
    TangentRows state(2 * n_, 3 * n_);
    for (int r = 0; r < 2 * n_; ++r) state(r, r) = 1;
    Step(k, unit_torque_, false, &state);
    LoopPeriod period{MatrixXd(2 * n_, 3 * n_), actions_[k].acts,
                      actions_[k].integrates};
    for (int r = 0; r < 2 * n_; ++r) {
      for (int c = 0; c < 3 * n_; ++c) period.step(r, c) = state(r, c);
    }
    run->periods.push_back(period);
  }

  // The controller's derivatives in period first + k.
  void Control(long first, long k) {
    const Action& action = actions_[k];
    const long size = state_.stride();
    for (int j = 0; j < n_; ++j) {
      const double *q = state_.row(j), acts = action.acts[j];
      double *last = last_rows_.row(j), *velocity = velocity_rows_.row(j),
             *integral = integral_rows_.row(j), *torque = torque_rows_.row(j);
      const double kp = values_.kp[j], kd = values_.kd[j];
      const double ki = action.integrates[j] * values_.ki[j] * period_;
      const double rate = (1 - decay_) / period_;
      for (long c = 0; c < size; ++c) {
        velocity[c] = decay_ * velocity[c] + rate * (q[c] - last[c]);
        torque[c] = acts * (integral[c] - kp * q[c] - kd * velocity[c]);
        integral[c] -= ki * q[c];
        last[c] = q[c];
      }
      const int delay = columns_.delay();
      const double qd = reference_.qd(first + k, j);
      torque[columns_.kp() + j] += acts * action.error[j];
      torque[columns_.kd() + j] += acts * action.velocity_error[j];
      torque[delay] -=
          acts * (kp * qd +
                  kd * velocity_feedforward_[j] * reference_.qdd(first + k, j) +
                  reference_.feedforward_rate(first + k, j));
      integral[columns_.ki() + j] +=
          action.integrates[j] * period_ * action.error[j];
      integral[delay] -= ki * qd;
    }
  }

  void AdvanceTangents(long first, long k, long* row, LoopRun* run) {
    const auto has_row = [&] {
      return *row < static_cast<long>(run->period_of_row.size()) &&
             run->period_of_row[*row] == first + k;
    };
    Control(first, k);
    if (has_row()) before_ = state_;
    Step(k, torque_rows_, true, &state_);
    for (; has_row(); ++*row) {
      const RowWeights w(run->share_of_row[*row], period_);
      for (int j = 0; j < n_; ++j) {
        const double *q0 = before_.row(j), *qd0 = before_.row(n_ + j);
        const double *q1 = state_.row(j), *qd1 = state_.row(n_ + j);
        for (int c = 0; c < columns_.size(); ++c) {
          run->by_values(n_ * *row + j, c) =
              w.q0 * q0[c] + w.qd0 * qd0[c] + w.q1 * q1[c] + w.qd1 * qd1[c];
        }
      }
    }
  }

  const ControllerOptions& options_;
  const LoopValues& values_;
  const ReferenceSeries& reference_;
  int n_;
  LoopColumns columns_;
  bool tangents_, periods_;
  double period_, decay_;
  StageStepper stepper_;
  MotionTangent tangent_;
  int substeps_;
  VectorXd last_, velocity_, integral_;
  VectorXd velocity_feedforward_;  // n, shares
  MatrixXd torque_;
  std::vector<Action> actions_;  // of a block
  StageMotion motion_;
  TangentRows state_, before_, last_rows_, velocity_rows_, integral_rows_,
      torque_rows_, unit_torque_;
};

}  // namespace

int EnoughSubsteps(const LoopValues& values, double rate_hz) {
  constexpr double kMoreFriction = 2;
  const StageStepper stepper(values.arm);
  const VectorXd q = VectorXd::Zero(stepper.num_joints());
  return std::clamp(static_cast<int>(std::ceil(
                        kMoreFriction / (rate_hz * stepper.SafeStep(q)))),
                    1, kMostSubsteps);
}

RowWeights::RowWeights(double share, double period) {
  const double s = share, r = 1 - s;
  q0 = r * r * (1 + 2 * s);
  q1 = s * s * (1 + 2 * r);
  qd0 = r * r * s * period;
  qd1 = -s * s * r * period;
}

PositionLoop::PositionLoop(const ControllerOptions& controller,
                           const CommandedReference& reference, const Log& log)
    : controller_(controller), reference_(reference), log_(log) {}

LoopRun PositionLoop::Run(const LoopValues& values, const LoopStart& start,
                          long first_row, long num_rows, Wanted wanted) const {
  CHECK_LE(first_row + num_rows, log_.size());
  const double begin = log_.t[first_row], period = 1 / controller_.rate_hz;
  const VectorXd rows =
      (log_.t.segment(first_row, num_rows).array() - begin) / period;
  const long periods =
      static_cast<long>(std::floor(rows[num_rows - 1] + .5)) + 1;
  const ReferenceSeries reference =
      reference_.At(begin, period, periods, values.delay);
  return Simulation(controller_, values, start, reference, wanted)
      .Run(rows, log_.q, first_row);
}

LoopStart PositionLoop::StartAt(long first_row) const {
  // A line through the first hundredth of a second, or four rows.
  constexpr double kSeconds = .01;
  long count = 4;
  while (first_row + count < log_.size() &&
         log_.t[first_row + count] < log_.t[first_row] + kSeconds) {
    ++count;
  }
  count = std::min<long>(count, log_.size() - first_row);
  const Eigen::ArrayXd t =
      log_.t.segment(first_row, count).array() - log_.t[first_row];
  const MatrixXd q = log_.q.middleRows(first_row, count);
  const Eigen::ArrayXd centred = t - t.mean();
  LoopStart start;
  start.qd = q.transpose() * centred.matrix() / centred.square().sum();
  start.q = q.colwise().mean().transpose() - t.mean() * start.qd;
  start.integral = VectorXd::Zero(q.cols());
  return start;
}

}  // namespace armcal
