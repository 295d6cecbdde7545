#include "calib/inspect/frozen_channels.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "calib/logs/wiring.h"
#include "calib/numerics/autoregression.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Nats by which both other hypotheses have to fail, as those of readings and
// zeros have to (log_reading.cc, joint_zero.cc).
constexpr double kNatsToClaim = 15;
constexpr double kRestingTime = 1;      // s, of a position, as of stuck columns
constexpr double kSlowestMotion = .02;  // rad/s or m/s, as of stuck columns
constexpr double kMovingShare = .2;     // of a joint's rms speed, as TorqueFit
constexpr size_t kSamplesOfFit = 500;
constexpr size_t kFewestOfFit = 60;
constexpr double kTanhWidth = .03;  // rad/s or m/s, as TorqueFit
// Static over sliding friction is .78 / .42 = 1.9 of hard steel on hard steel,
// dry (Marks' Standard Handbook for Mechanical Engineers).
constexpr double kBreakaway = 2;
constexpr double kBestShare = .01;  // of the torque: no model is better

struct EqualRows {
  int begin = 0, end = 0;  // rows
  int repeats = 0;         // of the row before, that count
};

// Runs of equal values, with one row at least, of rows that `count`.
std::vector<EqualRows> RunsOf(const VectorXd& x,
                              const std::vector<bool>& counts) {
  std::vector<EqualRows> runs;
  const auto rows = static_cast<int>(x.size());
  for (int k = 0; k < rows;) {
    EqualRows run{k, k + 1};
    bool any = counts[k];
    for (; run.end < rows && x[run.end] == x[k]; ++run.end) {
      run.repeats += counts[run.end] && counts[run.end - 1];
      any = any || counts[run.end];
    }
    if (any) runs.push_back(run);
    k = run.end;
  }
  return runs;
}

// Those that are too long for chance, beside the longest of the others.
std::vector<EqualRows> TooLong(std::vector<EqualRows> runs) {
  constexpr size_t kMostRuns = 8;
  std::sort(runs.begin(), runs.end(),
            [](const auto& a, const auto& b) { return a.repeats > b.repeats; });
  const double log_m = std::log(static_cast<double>(runs.size()));
  size_t count = 0;
  for (size_t k = 0; k < std::min(kMostRuns, runs.size()); ++k) {
    const int next = k + 1 < runs.size() ? runs[k + 1].repeats : 0;
    const double nats = log_m * (runs[k].repeats / std::max(1., 1. * next) - 1);
    if (nats > kNatsToClaim) count = k + 1;
  }
  runs.resize(count);
  return runs;
}

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
    for (const EqualRows& run : TooLong(RunsOf(tau, counts))) {
      candidates_.push_back({j, false, run.begin, run.end, tau[run.begin]});
    }
  }

  void AddPositions(int j) {
    const VectorXd q = log_.q.col(j);
    const std::vector<bool> all(log_.size(), true);
    for (const EqualRows& run : RunsOf(q, all)) {
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

  WiringSamples SamplesAt(const std::vector<int>& rows) const {
    WiringSamples samples;
    samples.motion.dt = series_.dt();
    samples.motion.q = series_.motion().q(rows, Eigen::all);
    samples.motion.qd = series_.motion().qd(rows, Eigen::all);
    samples.motion.qdd = series_.motion().qdd(rows, Eigen::all);
    samples.tau = series_.tau()(rows, Eigen::all);
    return samples;
  }

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
    const size_t all = rows.size();
    if (all < kFewestOfFit) return false;
    const size_t size = std::min(kSamplesOfFit, all);
    for (size_t k = 0; k < size; ++k) rows[k] = rows[k * all / size];
    rows.resize(size);
    SetFigures(SamplesAt(rows), j,
               static_cast<double>(all) / static_cast<double>(size));
    const auto half = rows.begin() + static_cast<long>(size / 2);
    fits_ = {FitTo(rows), FitTo({rows.begin(), half}),
             FitTo({half, rows.end()})};
    return true;
  }

  // What a fit to these samples, of `times` as many, is like; of joint j the
  // torque, too.
  void SetFigures(const WiringSamples& samples, int j, double times) {
    const TorqueFit fit(robot_, samples.motion);
    const MatrixXd ones =
        MatrixXd::Ones(samples.tau.rows(), samples.tau.cols());
    const VectorXd counts =
        fit.InMotion(ones).colwise().sum().transpose().cwiseMax(1);
    const MatrixXd tau = fit.InMotion(samples.tau);
    const VectorXd squares =
        tau.colwise().squaredNorm().transpose().cwiseQuotient(counts);
    left_ = fit.Squares(fit.Parameters(samples.tau), samples.tau)
                .cwiseQuotient(counts) +
            kBestShare * kBestShare * squares;
    mean_ = tau.col(j).sum() / counts[j];
    variance_ = squares[j] - mean_ * mean_;
    moved_ = counts[j] * times * series_.dt();
  }

  struct FittedArm {
    Robot robot;   // its links
    VectorXd own;  // viscous, Coulomb, offset, armature of each joint
  };
  FittedArm FitTo(const std::vector<int>& rows) const {
    const WiringSamples samples = SamplesAt(rows);
    const VectorXd x =
        TorqueFit(robot_, samples.motion).Parameters(samples.tau);
    FittedArm fitted{robot_, x.tail(4 * robot_.num_joints())};
    for (int i = 0; i < robot_.num_joints(); ++i) {
      fitted.robot.links[i].inertial =
          InertialParameters::FromVector(x.segment<10>(10 * i));
    }
    return fitted;
  }

  // The joint's torque by a fit; without its own where its position is what is
  // asked.
  static VectorXd Needed(const FittedArm& arm, const Motion& motion,
                         const FrozenChannel& run) {
    const int j = run.joint;
    VectorXd needed(motion.size());
    for (int s = 0; s < motion.size(); ++s) {
      needed[s] = InverseDynamics(arm.robot, motion.q.row(s), motion.qd.row(s),
                                  motion.qdd.row(s))[j];
      if (run.is_position) continue;
      const double qd = motion.qd(s, j);
      needed[s] += arm.own[4 * j] * qd +
                   arm.own[4 * j + 1] * std::tanh(qd / kTanhWidth) +
                   arm.own[4 * j + 2] + arm.own[4 * j + 3] * motion.qdd(s, j);
    }
    return needed;
  }

  // The variance of what is needed there beyond what is recorded, if that is
  // right: as elsewhere, and that of the fit itself, as the run may be where
  // the arm is nowhere else. Fits to two halves of the log have twice its
  // variance each, and their difference four times.
  double UsualVariance(const FrozenChannel& run, const Motion& motion) const {
    VectorXd apart =
        Needed(fits_[1], motion, run) - Needed(fits_[2], motion, run);
    if (run.is_position) apart.array() -= apart.mean();
    return left_[run.joint] +
           .25 * apart.squaredNorm() / static_cast<double>(apart.size());
  }

  // Of a torque: what the arm needs beyond the recorded one. At an end of the
  // range other than 0 it may be cut off there, and more would be needed.
  VectorXd OffTorque(const FrozenChannel& run,
                     const WiringSamples& samples) const {
    const VectorXd tau = log_.tau.col(run.joint);
    const VectorXd off =
        Needed(fits_[0], samples.motion, run).array() - run.value;
    if (run.value == 0) return off;
    if (run.value == tau.maxCoeff()) return off.cwiseMin(0);
    return run.value == tau.minCoeff() ? VectorXd(off.cwiseMax(0)) : off;
  }

  // Of a position: what its torque is beyond what a joint that rests there may
  // have, by friction or, where that leaves less, by a brake.
  VectorXd OffRest(const FrozenChannel& run,
                   const WiringSamples& samples) const {
    const VectorXd tau = samples.tau.col(run.joint);
    const VectorXd off = tau - Needed(fits_[0], samples.motion, run);
    const double middle = .5 * (off.minCoeff() + off.maxCoeff());
    const double friction = kBreakaway * fits_[0].own[4 * run.joint + 1];
    const VectorXd rest = off.unaryExpr([&](double x) {
      const double size = std::abs(x - middle) - friction;
      return size > 0 ? std::copysign(size, x - middle) : 0.;
    });
    const VectorXd brake = tau.array() - tau.mean();
    return brake.squaredNorm() < rest.squaredNorm() ? brake : rest;
  }

  // Nats by which a column has nothing to do with the arm: `off` is N(0, v) if
  // it has, and `unrelated` N(0, V + v) if not.
  double NatsOf(const VectorXd& off, const VectorXd& unrelated,
                double v) const {
    const double V = variance_ + v;
    const double of_sample =
        .5 * (off.squaredNorm() / v - unrelated.squaredNorm() / V) /
            static_cast<double>(off.size()) -
        .5 * std::log(V / v);
    return std::max(1., IndependentSamples(off)) * of_sample;
  }

  // Nats by which the other joints' torques say that a position is wrong: what
  // they leave there has another variance then, s^2, than elsewhere, v, and the
  // largest likelihood of any s is n/2 (s^2/v - 1 - log s^2/v) above that of v.
  double NatsOfOthers(const FrozenChannel& run,
                      const WiringSamples& samples) const {
    double nats = 0;
    for (int k = 0; k < robot_.num_joints(); ++k) {
      if (k == run.joint) continue;
      const FrozenChannel other{k, false, run.begin, run.end};
      const VectorXd off =
          Needed(fits_[0], samples.motion, other) - samples.tau.col(k);
      const double ratio = off.squaredNorm() / static_cast<double>(off.size()) /
                           UsualVariance(other, samples.motion);
      if (!(ratio > 1)) continue;
      nats += .5 * std::max(1., IndependentSamples(off)) *
              (ratio - 1 - std::log(ratio));
    }
    return nats;
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
    const WiringSamples samples = SamplesAt(rows);
    const VectorXd off =
        run->is_position ? OffRest(*run, samples) : OffTorque(*run, samples);
    const VectorXd unrelated =
        run->is_position ? VectorXd(samples.tau.col(run->joint).array() - mean_)
                         : off;
    const double v = UsualVariance(*run, samples.motion);
    run->nats = NatsOf(off, unrelated, v);
    if (run->is_position && run->nats > 0) {
      run->nats += NatsOfOthers(*run, samples);
    }
    run->gap = off.norm() / std::sqrt(off.size());
    run->usual = std::sqrt(v);
    return moved_ > kRestingTime && run->nats > kNatsToClaim;
  }

  const Robot& robot_;
  const Log& log_;
  const UniformSeries& series_;
  Eigen::RowVectorXd least_speed_;
  std::vector<FrozenChannel> candidates_;
  // Of the joint that is asked: mean and variance of its torque elsewhere, and
  // for how long it moves there, s. Of each what the fit leaves, (N m)^2 or
  // N^2.
  double mean_ = 0, variance_ = 0, moved_ = 0;
  VectorXd left_;
  std::vector<FittedArm> fits_;  // to all rows, and to two halves of them
};

}  // namespace

std::vector<FrozenChannel> FindFrozenChannels(const Robot& robot,
                                              const Log& log,
                                              const UniformSeries& series) {
  return FrozenSearch(robot, log, series).Run();
}

bool IsOf(const FrozenChannel& run, const InspectionFinding& finding) {
  const std::string signal = run.is_position ? "position" : "torque";
  return finding.joint == run.joint &&
         finding.sentence.compare(0, signal.size(), signal) == 0;
}

std::vector<InspectionFinding> FrozenFindings(
    const Robot& robot, const VectorXd& t,
    const std::vector<FrozenChannel>& frozen) {
  std::vector<InspectionFinding> findings;
  for (const FrozenChannel& run : frozen) {
    const std::string& joint = robot.links[run.joint].joint.name;
    InspectionFinding finding{
        "stuck",
        std::string("the ") + (run.is_position ? "position" : "torque") +
            " of " + joint +
            Format(" is stuck at %.6g from %.6g s to %.6g s", run.value,
                   t[run.begin], t[run.end - 1]),
        Format("%d rows of one number; ", run.end - run.begin) +
            Format(run.is_position
                       ? "its torque goes on, %.3g rms from what holds it at "
                         "rest, where a fit of the arm leaves %.3g elsewhere"
                       : "a fit of the arm to all other rows leaves %.3g rms "
                         "there and %.3g elsewhere",
                   run.gap, run.usual) +
            Format(" (%.0f nats)", run.nats),
        OptionName("fix") + " writes the log without these rows", run.joint};
    finding.leads = true;
    findings.push_back(finding);
  }
  return findings;
}

Log WithoutFrozenRows(const Log& log,
                      const std::vector<FrozenChannel>& frozen) {
  std::vector<int> rows;
  for (int k = 0; k < log.size(); ++k) {
    if (std::none_of(frozen.begin(), frozen.end(),
                     [k](const FrozenChannel& run) {
                       return run.begin <= k && k < run.end;
                     })) {
      rows.push_back(k);
    }
  }
  Log kept = log;
  kept.t = log.t(rows).eval();
  for (MatrixXd Log::*signal :
       {&Log::q, &Log::qd, &Log::qdd, &Log::tau, &Log::qref, &Log::temperature,
        &Log::wrench, &Log::current}) {
    if ((log.*signal).size() > 0) {
      kept.*signal = (log.*signal)(rows, Eigen::all).eval();
    }
  }
  return kept;
}

}  // namespace armcal
