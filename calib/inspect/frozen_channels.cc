#include "calib/inspect/frozen_channels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "calib/inspect/equal_rows.h"
#include "calib/inspect/rows_fit.h"
#include "calib/numerics/autoregression.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Nats by which chance has to fail, of thousands of runs: as many as readings
// and zeros are asked for (reading_state.h, joint_zero.cc).
constexpr double kNatsOfChance = 15;
// Right logs of which one may have a false claim. Of the 118 of ../shared/data,
// in which 559 runs are asked, none has more than .52 nats.
constexpr double kLogsOfOneClaim = 100;
constexpr double kRestingTime = 1;      // s, of a position, as of stuck columns
constexpr double kSlowestMotion = .02;  // rad/s or m/s, as of stuck columns
constexpr double kMovingShare = .2;     // of a joint's rms speed, as TorqueFit
// Static over sliding friction is .78 / .42 = 1.9 of hard steel on hard steel,
// dry (Marks' Standard Handbook for Mechanical Engineers).
constexpr double kBreakaway = 2;

class FrozenSearch {
 public:
  FrozenSearch(const Robot& robot, const Log& log, const UniformSeries& series)
      : robot_(robot), log_(log), series_(series) {
    const MatrixXd& qd = series.motion().qd;
    least_speed_ = kMovingShare * (qd.colwise().norm() / std::sqrt(qd.rows()));
  }

  std::vector<FrozenChannel> Run() {
    for (int j = 0; j < robot_.num_joints(); ++j) {
      AddTorques(j);
      AddPositions(j);
    }
    std::vector<FrozenChannel> frozen;
    int fitted_for = -1;
    for (FrozenChannel& candidate : candidates_) {
      const bool is_fitted = candidate.joint == fitted_for;
      if (!is_fitted && !FitBeside(candidate.joint)) continue;
      fitted_for = candidate.joint;
      if (Judge(&candidate)) frozen.push_back(candidate);
    }
    return frozen;
  }

 private:
  int SampleAt(int row) const {
    const double at = (log_.t[row] - series_.motion().t0) / series_.dt();
    const auto last = static_cast<int>(series_.motion().size()) - 1;
    return std::clamp(static_cast<int>(std::lround(at)), 0, last);
  }
  bool Moves(int sample, int j) const {
    const double speed = std::abs(series_.motion().qd(sample, j));
    return speed > std::max(kSlowestMotion, least_speed_[j]);
  }

  void AddTorques(int j) {
    std::vector<bool> counts(log_.size());
    for (int k = 0; k < log_.size(); ++k) counts[k] = Moves(SampleAt(k), j);
    const VectorXd tau = log_.tau.col(j);
    for (const EqualRows& run :
         TooLongForChance(RunsOfEqualRows(tau, counts), kNatsOfChance)) {
      candidates_.push_back({j, false, run.begin, run.end, tau[run.begin]});
    }
  }

  void AddPositions(int j) {
    const VectorXd q = log_.q.col(j);
    const std::vector<bool> all(log_.size(), true);
    for (const EqualRows& run : RunsOfEqualRows(q, all)) {
      if (log_.t[run.end - 1] - log_.t[run.begin] < kRestingTime) continue;
      candidates_.push_back({j, true, run.begin, run.end, q[run.begin]});
    }
  }

  // What the filter of the series makes of a column that stands still all of a
  // sudden lasts a period of its bandwidth.
  bool IsNear(int sample, const FrozenChannel& run, double reach) const {
    const double t = series_.motion().t0 + sample * series_.dt();
    return t > log_.t[run.begin] - reach && t < log_.t[run.end - 1] + reach;
  }
  double Reach() const { return 1 / series_.bandwidth_hz(); }

  // To what is near none of joint j's candidates; false where that is too
  // little.
  bool FitBeside(int j) {
    std::vector<int> rows;
    for (const int sample : series_.moving()) {
      if (std::none_of(candidates_.begin(), candidates_.end(),
                       [&](const FrozenChannel& run) {
                         return run.joint == j && IsNear(sample, run, Reach());
                       })) {
        rows.push_back(sample);
      }
    }
    if (rows.size() < RowsFit::kFewest) return false;
    fit_.emplace(robot_, series_, std::move(rows));
    return true;
  }

  // Of a torque: what the arm needs beyond the recorded one. At an end of the
  // range other than 0 it may be cut off there, and more would be needed.
  VectorXd OffTorque(const FrozenChannel& run,
                     const WiringSamples& samples) const {
    const VectorXd tau = log_.tau.col(run.joint);
    const VectorXd off =
        fit_->Torque(samples.motion, run.joint, true).array() - run.value;
    if (run.value == 0) return off;
    if (run.value == tau.maxCoeff()) return off.cwiseMin(0);
    return run.value == tau.minCoeff() ? VectorXd(off.cwiseMax(0)) : off;
  }

  // Of a position: what its torque is beyond what a joint that rests there may
  // have, by friction or, where that leaves less, by a brake.
  VectorXd OffRest(const FrozenChannel& run,
                   const WiringSamples& samples) const {
    const VectorXd tau = samples.tau.col(run.joint);
    const VectorXd off = tau - fit_->Torque(samples.motion, run.joint, false);
    const double middle = .5 * (off.minCoeff() + off.maxCoeff());
    const double friction = kBreakaway * fit_->coulomb(run.joint);
    const VectorXd rest = off.unaryExpr([&](double x) {
      const double size = std::abs(x - middle) - friction;
      return size > 0 ? std::copysign(size, x - middle) : 0.;
    });
    const VectorXd brake = tau.array() - tau.mean();
    return brake.squaredNorm() < rest.squaredNorm() ? brake : rest;
  }

  // Nats by which a column has nothing to do with the arm: `off` is N(0, v) if
  // it has, and `unrelated` N(0, V + v) if not.
  static double NatsOf(const VectorXd& off, const VectorXd& unrelated, double v,
                       double of_torque) {
    const double V = of_torque + v;
    const double of_sample =
        .5 * (off.squaredNorm() / v - unrelated.squaredNorm() / V) /
            static_cast<double>(off.size()) -
        .5 * std::log(V / v);
    return std::max(1., IndependentSamples(off)) * of_sample;
  }

  // Nats by which the other joints' torques say that a position is wrong: what
  // they leave there has another variance then, s^2, than elsewhere, v, and the
  // largest likelihood of any s is n/2 (s^2/v - 1 - log s^2/v) above that of v,
  // of which log(n)/2 are what a fitted number gains by itself (Schwarz 1978).
  double NatsOfOthers(const FrozenChannel& run,
                      const WiringSamples& samples) const {
    double nats = 0;
    for (int k = 0; k < robot_.num_joints(); ++k) {
      if (k == run.joint) continue;
      const VectorXd off =
          fit_->Torque(samples.motion, k, true) - samples.tau.col(k);
      const double ratio = off.squaredNorm() / static_cast<double>(off.size()) /
                           fit_->VarianceAbout(samples.motion, k, true);
      if (!(ratio > 1)) continue;
      const double n = std::max(1., IndependentSamples(off));
      nats += std::max(
          0., .5 * n * (ratio - 1 - std::log(ratio)) - .5 * std::log(n));
    }
    return nats;
  }

  // Each run that is asked may be claimed by mistake.
  double NatsToClaim() const {
    return std::log(kLogsOfOneClaim * static_cast<double>(candidates_.size()));
  }

  // A drive that is off while a brake stops its joint has a torque of zero,
  // rightly. What brakes takes power; where a joint gains speed, its drive or
  // its links give some.
  bool Counts(const FrozenChannel& run, int sample) const {
    if (run.is_position) return IsNear(sample, run, -Reach());
    const Motion& motion = series_.motion();
    const double power =
        motion.qd(sample, run.joint) * motion.qdd(sample, run.joint);
    return Moves(sample, run.joint) && IsNear(sample, run, 0) &&
           (run.value != 0 || power > 0);
  }

  bool Judge(FrozenChannel* run) const {
    std::vector<int> rows;
    for (const int s : series_.moving()) {
      if (Counts(*run, s)) rows.push_back(s);
    }
    if (rows.size() < 3) return false;
    const WiringSamples samples = SamplesAt(series_, rows);
    const VectorXd off =
        run->is_position ? OffRest(*run, samples) : OffTorque(*run, samples);
    const VectorXd unrelated =
        run->is_position ? VectorXd(samples.tau.col(run->joint).array() -
                                    fit_->mean(run->joint))
                         : off;
    const double v =
        fit_->VarianceAbout(samples.motion, run->joint, !run->is_position);
    run->nats = NatsOf(off, unrelated, v, fit_->variance(run->joint));
    if (run->is_position && run->nats > 0) {
      run->nats += NatsOfOthers(*run, samples);
    }
    run->gap = off.norm() / std::sqrt(off.size());
    run->usual = std::sqrt(v);
    return fit_->time_in_motion(run->joint) > kRestingTime &&
           run->nats > NatsToClaim();
  }

  const Robot& robot_;
  const Log& log_;
  const UniformSeries& series_;
  Eigen::RowVectorXd least_speed_;
  std::vector<FrozenChannel> candidates_;
  std::optional<RowsFit> fit_;  // of the joint that is asked
};

}  // namespace

std::vector<FrozenChannel> FindFrozenChannels(const Robot& robot,
                                              const Log& log,
                                              const UniformSeries& series) {
  return FrozenSearch(robot, log, series).Run();
}

}  // namespace armcal
