#include "model/plant/reference_motion.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "model/plant/random_stream.h"

namespace armcal {

namespace {

constexpr double kTwoPi = 6.283185307179586;

// The part of a joint's range and speed that a motion may use.
struct JointRange {
  double center, half_width, speed;
};

JointRange RangeOf(const Joint& joint, const MotionOptions& options) {
  const bool turns = IsRotational(joint.type);
  const double widest = turns ? 1.5 : .2;
  JointRange range;
  const bool limited = joint.type != JointType::kContinuous &&
                       std::isfinite(joint.lower) && std::isfinite(joint.upper);
  range.center = limited ? (joint.lower + joint.upper) / 2 : 0;
  range.half_width =
      options.size *
      std::min(limited ? (joint.upper - joint.lower) / 2 : widest, widest);
  range.speed = options.speed * std::min(joint.velocity, turns ? 2 : .5);
  return range;
}

std::vector<JointRange> Ranges(const Robot& robot,
                               const MotionOptions& options) {
  std::vector<JointRange> ranges;
  for (int j = 0; j < robot.num_joints(); ++j) {
    ranges.push_back(RangeOf(robot.links[j].joint, options));
    const auto& moving = options.joints;
    if (moving.empty() ||
        std::find(moving.begin(), moving.end(), j) != moving.end()) {
      continue;
    }
    ranges.back().half_width = 0;
  }
  return ranges;
}

// 10 s^3 - 15 s^4 + 6 s^5 and its derivatives by s, for s in [0, 1].
struct Quintic {
  double value, rate, rate2;
  explicit Quintic(double s)
      : value(s * s * s * (10 + s * (6 * s - 15))),
        rate(30 * s * s * (1 - s) * (1 - s)),
        rate2(60 * s * (1 - s) * (1 - 2 * s)) {}
};

ReferencePoint Zero(int n) {
  return {Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n),
          Eigen::VectorXd::Zero(n)};
}

constexpr int kHarmonics = 5;
constexpr double kBaseHz = .1;
constexpr double kOnset = 1;  // s

struct Fourier {
  Eigen::VectorXd center;
  Eigen::MatrixXd amplitude, phase;  // n x kHarmonics
  double duration;

  ReferencePoint Sum(double t) const {
    ReferencePoint point = Zero(center.size());
    for (int k = 0; k < kHarmonics; ++k) {
      const double omega = kTwoPi * kBaseHz * (k + 1);
      for (int j = 0; j < center.size(); ++j) {
        const double a = amplitude(j, k), x = omega * t + phase(j, k);
        point.q[j] += a * std::sin(x);
        point.qd[j] += a * omega * std::cos(x);
        point.qdd[j] -= a * omega * omega * std::sin(x);
      }
    }
    return point;
  }

  // The sum behind an envelope that rises and falls within kOnset.
  ReferencePoint At(double t) const {
    ReferencePoint point = Sum(t);
    const double from_end = std::min(t, duration - t);
    if (from_end < kOnset) {
      const Quintic e(std::max(from_end, 0.0) / kOnset);
      const double rate = (t < duration / 2 ? 1 : -1) * e.rate / kOnset;
      const double rate2 = e.rate2 / (kOnset * kOnset);
      point.qdd = e.value * point.qdd + 2 * rate * point.qd + rate2 * point.q;
      point.qd = e.value * point.qd + rate * point.q;
      point.q *= e.value;
    }
    point.q += center;
    return point;
  }
};

struct Move {
  double begin, duration;
  Eigen::VectorXd from, to;
};

ReferencePoint AtMoves(const std::vector<Move>& moves, double t) {
  const auto next = std::upper_bound(
      moves.begin(), moves.end(), t,
      [](double time, const Move& move) { return time < move.begin; });
  const Move& move = next == moves.begin() ? *next : *std::prev(next);
  const double s = std::clamp((t - move.begin) / move.duration, 0.0, 1.0);
  const Quintic shape(s);
  const Eigen::VectorXd way = move.to - move.from;
  return {move.from + shape.value * way, shape.rate / move.duration * way,
          shape.rate2 / (move.duration * move.duration) * way};
}

}  // namespace

ReferenceMotion FourierMotion(const Robot& robot,
                              const MotionOptions& options) {
  const int n = robot.num_joints();
  const auto ranges = Ranges(robot, options);
  std::mt19937_64 random =
      RandomStream(options.seed, options.run, RandomPurpose::kMotion);
  std::uniform_real_distribution<double> uniform(0, 1);
  auto motion = std::make_shared<Fourier>();
  motion->duration = options.duration;
  motion->center.resize(n);
  motion->amplitude.resize(n, kHarmonics);
  motion->phase.resize(n, kHarmonics);
  for (int j = 0; j < n; ++j) {
    motion->center[j] = ranges[j].center;
    for (int k = 0; k < kHarmonics; ++k) {
      motion->amplitude(j, k) = (.2 + uniform(random)) / (k + 1);
      motion->phase(j, k) = kTwoPi * uniform(random);
    }
  }
  // Amplitudes as large as range and speed allow on a grid finer than the
  // fastest harmonic.
  Eigen::ArrayXd reach = Eigen::ArrayXd::Zero(n), speed = reach;
  for (double t = 0; t < 1 / kBaseHz; t += .01) {
    const ReferencePoint point = motion->Sum(t);
    reach = reach.max(point.q.array().abs());
    speed = speed.max(point.qd.array().abs());
  }
  for (int j = 0; j < n; ++j) {
    motion->amplitude.row(j) *=
        std::min(ranges[j].half_width / reach[j], ranges[j].speed / speed[j]);
  }
  return {options.duration, [motion](double t) { return motion->At(t); }};
}

ReferenceMotion PointToPointMotion(const Robot& robot,
                                   const MotionOptions& options) {
  constexpr double kRest = .3;          // s
  constexpr double kPeakSpeed = 1.875;  // of a quintic, over the mean
  const int n = robot.num_joints();
  const auto ranges = Ranges(robot, options);
  std::mt19937_64 random =
      RandomStream(options.seed, options.run, RandomPurpose::kMotion);
  std::uniform_real_distribution<double> uniform(-1, 1);
  auto moves = std::make_shared<std::vector<Move>>();
  Eigen::VectorXd at(n);
  for (int j = 0; j < n; ++j) at[j] = ranges[j].center;
  for (double t = 0;;) {
    Move move{t, .5, at, at};
    for (int j = 0; j < n; ++j) {
      move.to[j] = ranges[j].center + ranges[j].half_width * uniform(random);
      move.duration =
          std::max(move.duration,
                   kPeakSpeed * std::abs(move.to[j] - at[j]) / ranges[j].speed);
    }
    t += move.duration + kRest;
    if (t > options.duration && !moves->empty()) break;
    at = move.to;
    moves->push_back(move);
  }
  return {options.duration, [moves](double t) { return AtMoves(*moves, t); }};
}

ReferenceMotion WithStandstill(const ReferenceMotion& motion, double before,
                               double after) {
  const auto at = [motion, before](double t) {
    const double time = std::clamp(t - before, 0.0, motion.duration);
    ReferencePoint point = motion.at(time);
    if (time != t - before) {
      point.qd.setZero();
      point.qdd.setZero();
    }
    return point;
  };
  return {before + motion.duration + after, at};
}

}  // namespace armcal
