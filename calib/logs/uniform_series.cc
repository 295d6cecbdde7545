#include "calib/logs/uniform_series.h"

#include <algorithm>
#include <cmath>

#include "model/signals/low_pass.h"
#include "model/signals/standstill.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLongestDelay = .1;  // s, of torques

}  // namespace

MatrixXd Interpolated(const VectorXd& stamps, const MatrixXd& values,
                      const VectorXd& times) {
  MatrixXd at(times.size(), values.cols());
  Eigen::Index k = 0;
  for (Eigen::Index s = 0; s < times.size(); ++s) {
    while (k + 2 < stamps.size() && stamps[k + 1] < times[s]) ++k;
    const double step = stamps[k + 1] - stamps[k];
    const double share =
        step > 0 ? std::clamp((times[s] - stamps[k]) / step, 0., 1.) : 0;
    at.row(s) = (1 - share) * values.row(k) + share * values.row(k + 1);
  }
  return at;
}

UniformSeries::UniformSeries(const Log& log, double dt, double longest_gap,
                             double bandwidth_hz)
    : dt_(dt), bandwidth_hz_(bandwidth_hz) {
  const int size =
      1 + static_cast<int>((log.t[log.size() - 1] - log.t[0]) / dt);
  const VectorXd times =
      log.t[0] + dt * VectorXd::LinSpaced(size, 0, size - 1).array();
  motion_.t0 = log.t[0];
  motion_.dt = dt;
  motion_.q =
      ZeroPhaseLowPass(Interpolated(log.t, log.q, times), 1 / dt, bandwidth_hz);
  motion_.qd = Differentiate(motion_.q, dt);
  motion_.qdd = Differentiate(motion_.qd, dt);
  if (log.tau.size() > 0) {
    tau_ = ZeroPhaseLowPass(Interpolated(log.t, log.tau, times), 1 / dt,
                            bandwidth_hz);
  }
  reach_ = static_cast<int>(std::ceil((1 / bandwidth_hz + kLongestDelay) / dt));
  Eigen::Array<bool, Eigen::Dynamic, 1> out =
      FindStandstill(MeanVelocity(motion_.q, dt), dt,
                     static_cast<int>(kStandstillMeanTime / dt / 2));
  const auto leave_out = [&](double begin, double end) {
    const int first = static_cast<int>((begin - log.t[0]) / dt) - reach_;
    const int last = static_cast<int>((end - log.t[0]) / dt) + reach_;
    for (int s = std::max(0, first); s <= std::min(size - 1, last); ++s) {
      out[s] = true;
    }
  };
  leave_out(log.t[0], log.t[0]);
  leave_out(log.t[log.size() - 1], log.t[log.size() - 1]);
  const auto before = (!out).count();
  for (int k = 0; k + 1 < log.size(); ++k) {
    if (log.t[k + 1] - log.t[k] > longest_gap) {
      leave_out(log.t[k], log.t[k + 1]);
    }
  }
  moving_at_gaps_ = static_cast<int>(before - (!out).count());
  for (int s = 0; s < size; ++s) {
    if (!out[s]) moving_.push_back(s);
  }
}

WiringSamples UniformSeries::Pick(int count, double delay) const {
  const int size = std::min(count, num_moving());
  std::vector<int> rows(size);
  for (int k = 0; k < size; ++k) {
    rows[k] = moving_[static_cast<long>(k) * num_moving() / size];
  }
  WiringSamples samples;
  samples.motion.dt = dt_;
  samples.motion.q = motion_.q(rows, Eigen::all);
  samples.motion.qd = motion_.qd(rows, Eigen::all);
  samples.motion.qdd = motion_.qdd(rows, Eigen::all);
  samples.tau.resize(size, tau_.cols());
  const double steps = std::clamp(delay, -kLongestDelay, kLongestDelay) / dt_;
  const int whole = static_cast<int>(std::floor(steps));
  const double share = steps - whole;
  for (int k = 0; k < size; ++k) {
    const int at = rows[k] + whole;
    samples.tau.row(k) =
        (1 - share) * tau_.row(at) +
        share * tau_.row(std::min<int>(at + 1, tau_.rows() - 1));
  }
  return samples;
}

}  // namespace armcal
