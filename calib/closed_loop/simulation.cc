#include "calib/closed_loop/simulation.h"

#include <algorithm>

#include "model/dynamics/batch_rollout.h"
#include "model/dynamics/drive_filters.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The drives of one stretch.
class Drives {
 public:
  Drives(const ControllerOptions& controller, const LoopValues& values,
         const LoopStretch& stretch, const LoopStart& start, LoopTrack* track)
      : values_(values),
        stretch_(stretch),
        track_(*track),
        n_(static_cast<int>(start.q.size())),
        decay_(LowPassDecay(controller.velocity_filter_hz, controller.rate_hz)),
        last_(start.q - stretch.period() * start.qd),
        velocity_(start.qd),
        integral_(start.integral) {
    const long periods = stretch.num_periods();
    track_.reference = stretch.Reference(values.delay);
    track_.q.resize(periods + 1, n_);
    track_.qd.resize(periods + 1, n_);
    for (MatrixXd* x :
         {&track_.error, &track_.velocity_error, &track_.behind}) {
      x->resize(periods, n_);
    }
    track_.slopes.resize(periods * n_);
    track_.torque_squares = VectorXd::Zero(n_);
    for (const DriveLaw& drive : values.drives) {
      lags_.emplace_back(drive.lag, stretch.period());
    }
  }

  long num_periods() const { return stretch_.num_periods(); }
  // Keeps where the arm is when period k begins.
  void See(long k, int j, double q, double qd) {
    track_.q(k, j) = q;
    track_.qd(k, j) = qd;
  }
  // The mean torque of joint j in period k.
  double Torque(long k, int j) {
    const double q = track_.q(k, j), period = stretch_.period();
    velocity_[j] =
        decay_ * velocity_[j] + (1 - decay_) / period * (q - last_[j]);
    last_[j] = q;
    const DriveLaw& law = values_.drives[j];
    const ReferenceSeries& at = track_.reference;
    const DriveOutput out = Drive(
        law, {at.q(k, j), at.qd(k, j), at.feedforward(k, j), q, velocity_[j]},
        integral_[j]);
    integral_[j] += period * out.integral_rate;
    track_.error(k, j) = at.q(k, j) - q;
    track_.velocity_error(k, j) = out.velocity_error;
    track_.slopes[n_ * k + j] = SlopesOf(law, out);
    track_.torque_squares[j] += out.torque * out.torque;
    const double mean = lags_[j].Mean(out.torque);
    track_.behind(k, j) = lags_[j].behind();
    return mean;
  }

 private:
  const LoopValues& values_;
  const LoopStretch& stretch_;
  LoopTrack& track_;
  int n_;
  double decay_;
  VectorXd last_, velocity_, integral_;
  std::vector<LaggedTorque> lags_;
};

}  // namespace

VectorXd LoopTrack::Residual(const LoopStretch& stretch) const {
  const long n = q.cols();
  VectorXd residual(n * stretch.num_rows());
  for (long row = 0; row < stretch.num_rows(); ++row) {
    const long k = stretch.period_of(row);
    const RowWeights w(stretch.share_of(row), stretch.period());
    residual.segment(n * row, n) =
        (stretch.log().q.row(stretch.first_row() + row) - w.q0 * q.row(k) -
         w.qd0 * qd.row(k) - w.q1 * q.row(k + 1) - w.qd1 * qd.row(k + 1))
            .transpose();
  }
  return residual;
}

// Windows run in lockstep, a lane each, with the torque held over each period
// as drives hold it. A window that is shorter ends by itself; one whose
// simulation is lost before its end is not finite.
std::vector<LoopTrack> SimulateLoop(
    const ControllerOptions& controller, const LoopValues& values,
    const std::vector<const LoopStretch*>& stretches,
    const std::vector<LoopStart>& starts) {
  const auto n = static_cast<int>(values.drives.size());
  const auto count = static_cast<int>(stretches.size());
  std::vector<LoopTrack> tracks(count);
  std::vector<Drives> drives;
  RolloutStates states{MatrixXd(count, n), MatrixXd(count, n), {}, {}};
  long periods = 0;
  for (int w = 0; w < count; ++w) {
    drives.emplace_back(controller, values, *stretches[w], starts[w],
                        &tracks[w]);
    states.q.row(w) = starts[w].q;
    states.qd.row(w) = starts[w].qd;
    for (int j = 0; j < n; ++j) {
      drives[w].See(0, j, starts[w].q[j], starts[w].qd[j]);
    }
    periods = std::max(periods, drives[w].num_periods());
  }
  const int substeps = values.substeps;
  MatrixXd torque = MatrixXd::Zero(count, n);  // of the period
  const BatchRollout rollout({values.arm});
  const auto command = [&](const BatchRollout::Batch& at, double* begin,
                           double* end) {
    const long k = at.step / substeps;
    for (int lane = 0; lane < at.count; ++lane) {
      const int w = at.first + lane;
      for (int j = 0; j < n; ++j) {
        if (at.step % substeps == 0 && k < drives[w].num_periods()) {
          torque(w, j) = drives[w].Torque(k, j);
        }
        begin[j * at.stride + lane] = end[j * at.stride + lane] = torque(w, j);
      }
    }
  };
  const auto see = [&](const BatchRollout::Batch& at) {
    if (at.step % substeps != 0) return;
    const long k = at.step / substeps;
    for (int lane = 0; lane < at.count; ++lane) {
      const int w = at.first + lane;
      for (int j = 0; j < n && k <= drives[w].num_periods(); ++j) {
        drives[w].See(k, j, at.q[j * at.stride + lane],
                      at.qd[j * at.stride + lane]);
      }
    }
  };
  rollout.Run(0, stretches[0]->period() / substeps, periods * substeps, command,
              see, &states);
  for (int w = 0; w < count; ++w) {
    const long lost = states.lost[w];
    tracks[w].finite = lost < 0 || lost > substeps * drives[w].num_periods();
  }
  return tracks;
}

}  // namespace armcal
