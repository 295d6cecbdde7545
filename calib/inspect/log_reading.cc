#include "calib/inspect/log_reading.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "model/robot/axis_rotation.h"

namespace armcal {
namespace {

using Eigen::Vector3d;

// Of 7 joints or fewer; the work grows with the joints' fifth power.
constexpr int kSamplesOfReading = 250;
constexpr double kLeastGain = 15;      // nats
constexpr double kLeastDelay = .0125;  // s; filters and drives have less
constexpr double kLeastTilt = 5;       // degrees
constexpr int kMostChanges = 4;

using Kind = ReadingChange::Kind;

struct Candidate {
  LogReading reading;
  ReadingChange change;
};

std::vector<Candidate> WiringCandidates(const LogReading& from) {
  std::vector<Candidate> all;
  const auto n = static_cast<int>(from.wiring.column.size());
  for (int j = 0; j < n; ++j) {
    for (int k = j + 1; k < n; ++k) {
      all.push_back({from, {Kind::kExchanged, j, k}});
      std::vector<int>& column = all.back().reading.wiring.column;
      std::swap(column[j], column[k]);
    }
    for (const Kind kind :
         {Kind::kPositionSign, Kind::kTorqueSign, Kind::kJointSign}) {
      all.push_back({from, {kind, j}});
      Wiring& wiring = all.back().reading.wiring;
      if (kind != Kind::kTorqueSign) wiring.position_sign[j] *= -1;
      if (kind != Kind::kPositionSign) wiring.torque_sign[j] *= -1;
    }
  }
  return all;
}

std::vector<Candidate> GravityCandidates(const LogReading& from,
                                         double magnitude) {
  std::vector<Candidate> all = {{from, {Kind::kGravity}}};
  all[0].reading.gravity.setZero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1., 1.}) {
      all.push_back({from, {Kind::kGravity}});
      all.back().reading.gravity = sign * magnitude * Vector3d::Unit(axis);
    }
  }
  return all;
}

bool IsOneSign(Kind kind) {
  return kind == Kind::kPositionSign || kind == Kind::kTorqueSign;
}

class Reader {
 public:
  Reader(const Robot& robot, const UniformSeries& series)
      : robot_(robot),
        series_(series),
        samples_(kSamplesOfReading * 7 / std::max(7, robot.num_joints())),
        best_(robot) {}

  ReadingFinding Run() {
    ReadingFinding finding{best_, {}, 0, 0};
    least_ = Misfit(best_, &finding.residual_percent_as_is);
    while (static_cast<int>(changes_.size()) < kMostChanges && Improve()) {
    }
    RefineGravity();
    finding.reading = best_;
    finding.changes = changes_;
    Misfit(best_, &finding.residual_percent);
    return finding;
  }

 private:
  TorqueFit FitOf(const LogReading& reading) const {
    Robot robot = robot_;
    robot.gravity = reading.gravity;
    return {robot, SamplesOf(reading).motion};
  }
  WiringSamples SamplesOf(const LogReading& reading) const {
    return SamplesAs(reading, robot_, series_, samples_);
  }
  double Misfit(const LogReading& reading, double* percent = nullptr) const {
    return FitOf(reading).Misfit(SamplesOf(reading).tau, percent);
  }

  // One discrete change, the best; false where none is worth it.
  bool Improve() {
    std::vector<Candidate> all = WiringCandidates(best_);
    const double magnitude =
        robot_.gravity.norm() > 0 ? robot_.gravity.norm() : 9.81;
    for (const Candidate& candidate : GravityCandidates(best_, magnitude)) {
      if (candidate.reading.gravity != best_.gravity) all.push_back(candidate);
    }
    all.push_back({best_, {Kind::kDegrees}});
    all.back().reading.degrees = !best_.degrees;
    all.push_back(BestDelay());
    std::vector<double> misfits;
    for (const Candidate& candidate : all) {
      misfits.push_back(Misfit(candidate.reading));
    }
    const size_t k =
        std::min_element(misfits.begin(), misfits.end()) - misfits.begin();
    if (!(misfits[k] < least_ - kLeastGain)) return false;
    double sum = 0;
    for (const double misfit : misfits) sum += std::exp(misfits[k] - misfit);
    for (size_t i = 0; i < all.size(); ++i) {
      const bool other_sign = all[i].change.joint == all[k].change.joint &&
                              IsOneSign(all[i].change.kind) &&
                              IsOneSign(all[k].change.kind) && i != k;
      if (other_sign && misfits[i] < misfits[k] + kLeastGain) {
        all[k].change.or_other_sign = true;
      }
    }
    Accept(all[k], misfits[k], 1 / sum);
    return true;
  }

  void Accept(Candidate candidate, double misfit, double probability) {
    candidate.change.gain = least_ - misfit;
    candidate.change.probability = probability;
    changes_.push_back(candidate.change);
    best_ = candidate.reading;
    least_ = misfit;
  }

  // A tilt about the world's horizontal axes, by ever smaller steps.
  void RefineGravity() {
    if (best_.gravity.norm() == 0) return;
    LogReading at = best_;
    double misfit = least_;
    const Vector3d down = best_.gravity.normalized();
    const Vector3d across = down.unitOrthogonal();
    const Vector3d axes[] = {across, down.cross(across)};
    for (double step = 16; step >= 1; step /= 2) {
      for (bool moved = true; moved;) {
        moved = false;
        for (const Vector3d& axis : axes) {
          for (const double sign : {-1., 1.}) {
            LogReading next = at;
            next.gravity =
                Eigen::AngleAxisd(sign * step * kDegree, axis) * at.gravity;
            const double value = Misfit(next);
            if (value >= misfit) continue;
            misfit = value;
            at = next;
            moved = true;
          }
        }
      }
    }
    const double tilt =
        std::acos(std::min(1., at.gravity.normalized().dot(down))) / kDegree;
    if (tilt < kLeastTilt || misfit > least_ - kLeastGain) return;
    // One change of gravity, not two.
    const auto before = std::find_if(
        changes_.begin(), changes_.end(),
        [](const ReadingChange& c) { return c.kind == Kind::kGravity; });
    if (before == changes_.end()) {
      Accept({at, {Kind::kGravity}}, misfit, 1);
    } else {
      before->gain += least_ - misfit;
      best_ = at;
      least_ = misfit;
    }
  }

  // By coarse steps, then by the parabola through the best three.
  Candidate BestDelay() const {
    constexpr double kMost = .08, kStep = .005;
    Candidate best{best_, {Kind::kDelay}};
    const TorqueFit fit = FitOf(best_);  // the motion stays
    const auto misfit_at = [&](double delay) {
      LogReading at = best_;
      at.delay = delay;
      return fit.Misfit(SamplesOf(at).tau);
    };
    double least = least_, delay = best_.delay;
    for (int k = -static_cast<int>(kMost / kStep); k * kStep <= kMost; ++k) {
      const double here = misfit_at(k * kStep);
      if (here >= least) continue;
      least = here;
      delay = k * kStep;
    }
    const double before = misfit_at(delay - kStep);
    const double after = misfit_at(delay + kStep);
    const double curvature = before + after - 2 * least;
    if (curvature > 0) delay += kStep * (before - after) / (2 * curvature);
    best.reading.delay = std::abs(delay) < kLeastDelay ? best_.delay : delay;
    return best;
  }

  const Robot& robot_;
  const UniformSeries& series_;
  const int samples_;
  LogReading best_;
  double least_ = 0;
  std::vector<ReadingChange> changes_;
};

}  // namespace

WiringSamples SamplesAs(const LogReading& reading, const Robot& robot,
                        const UniformSeries& series, int count) {
  WiringSamples samples =
      Rewired(series.Pick(count, reading.delay), reading.wiring);
  for (int j = 0; reading.degrees && j < robot.num_joints(); ++j) {
    if (!IsRotational(robot.links[j].joint.type)) continue;
    samples.motion.q.col(j) *= kDegree;
    samples.motion.qd.col(j) *= kDegree;
    samples.motion.qdd.col(j) *= kDegree;
  }
  return samples;
}

ReadingFinding FindReading(const Robot& robot, const UniformSeries& series) {
  return Reader(robot, series).Run();
}

}  // namespace armcal
