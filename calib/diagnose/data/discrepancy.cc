#include "calib/diagnose/data/discrepancy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Cycles per turn of position.
constexpr int kHarmonics = 9;
constexpr double kHarmonicStep = .6;
constexpr int kSignStep = 2;  // each second harmonic with the sign
constexpr int kSignHarmonics = (kHarmonics + kSignStep - 1) / kSignStep;
// tanh(qd / (share of the top speed)) less the sign: the curve of friction.
constexpr std::array<double, 3> kSpeedShares = {.1, .3, 1};
constexpr int kLoadShapes = 5;
constexpr int kStateShapes = 20;
constexpr int kTimeShapes = 6;      // half cosines over the log
constexpr double kSignWidth = .01;  // rad/s

constexpr int kOfState = 2 * kHarmonics + 2 * kSignHarmonics +
                         static_cast<int>(kSpeedShares.size()) + kLoadShapes +
                         kStateShapes + 1;

// A Gaussian over the frequency of position: ripples of gears are of few cycles
// per turn, and what is quick belongs to no routine.
double HarmonicSize(int k) {
  const double cycles = kHarmonicStep * (k + 1);
  return std::exp(-std::pow(cycles / Limits().discrepancy_cycles, 2) / 2);
}

}  // namespace

// Random Fourier features (Rahimi and Recht 2007): cosines of w' state + b, w
// drawn from the spectral density of the kernel, normal here, and b from [0, 2
// pi), have the covariance exp(-|s - s'|^2 kappa^2 / 2) of a Gaussian kernel in
// expectation, with kStateShapes of them per joint. They are drawn with a fixed
// seed, so that the same robot has the same discrepancy. A joint that slides
// has its way for a turn.
Discrepancy::Discrepancy(const Robot& robot, const MotionScale& scale, int logs,
                         double torque_constants_stddev)
    : scale_(scale),
      logs_(logs),
      torque_constants_stddev_(torque_constants_stddev) {
  const int n = robot.num_joints();
  per_turn_ = VectorXd::Ones(n);
  for (int j = 0; j < n; ++j) {
    // What a turn is to a joint that turns, its way is to one that slides.
    const double way = scale.high[j] - scale.low[j];
    if (!IsRotational(robot.links[j].joint.type) && way > 0) {
      per_turn_[j] = 2 * M_PI / way;
    }
  }
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0,
                                          Limits().discrepancy_state_frequency);
  std::uniform_real_distribution<double> angle(0, 2 * M_PI);
  for (int j = 0; j < n; ++j) {
    frequency_.emplace_back(2 * n, kStateShapes);
    phase_.emplace_back(kStateShapes);
    for (double& value : frequency_.back().reshaped()) value = normal(random);
    for (double& value : phase_.back()) value = angle(random);
  }
}

// How large each shape of joint j may be, one after the other as Torque has
// them, as shares of the joint's usual torque (Limits().discrepancy and
// discrepancy_of_sign). The friction curve may differ by a share of the joint's
// Coulomb friction. Shapes of time are as large as friction along the way, and
// are of one log each.
VectorXd Discrepancy::Spreads(int j, const Joint& joint) const {
  VectorXd spreads(kOfState + kTimeShapes * logs_);
  const double usual = scale_.torque[j];
  int at = 0;
  const auto add = [&](int count, double spread) {
    spreads.segment(at, count).setConstant(spread);
    at += count;
  };
  for (int k = 0; k < kHarmonics; ++k) {
    add(2, Limits().discrepancy * usual * HarmonicSize(k));
  }
  for (int k = 0; k < kHarmonics; k += kSignStep) {
    add(2, Limits().discrepancy_of_sign * usual * HarmonicSize(k));
  }
  add(kSpeedShares.size(),
      Limits().discrepancy_friction_curve * std::abs(joint.coulomb));
  add(kLoadShapes, Limits().discrepancy * usual);
  add(kStateShapes, Limits().discrepancy * usual);
  // Of the model's torque: the recorded one would explain whatever is recorded.
  add(1, torque_constants_stddev_ * usual);
  add(kTimeShapes * logs_, Limits().discrepancy_of_sign * usual);
  return spreads;
}

// sqrt(sum_k spread_k^2 <phi_k^2>), with the mean squares of the shapes: a half
// of cosines, about one of load's at the usual load, 1 / kStateShapes of the
// random features, which add up to one, and less than a half of a friction
// curve's. No joints: 0.
double Discrepancy::Deviation(int j, const Joint& joint) const {
  if (frequency_.empty()) return 0;
  const VectorXd squares = Spreads(j, joint).cwiseAbs2();
  constexpr int kCosines = 2 * kHarmonics + 2 * kSignHarmonics +
                           static_cast<int>(kSpeedShares.size());
  const double cosines =
      squares.head(kCosines).sum() + squares.tail(kTimeShapes).sum();
  return std::sqrt(cosines / 2 + squares.segment(kCosines, kLoadShapes).sum() +
                   squares[kCosines + kLoadShapes]);
}

bool Discrepancy::IsOfTime(int k) const { return k >= kOfState; }

// Positions as turns and speeds in units of the usual: samples x 2n.
MatrixXd Discrepancy::State(const Motion& motion) const {
  MatrixXd state(motion.size(), 2 * motion.num_joints());
  for (int j = 0; j < motion.num_joints(); ++j) {
    state.col(j) = per_turn_[j] * motion.q.col(j);
    state.col(motion.num_joints() + j) =
        motion.qd.col(j) / std::max(1e-3, scale_.speed[j]);
  }
  return state;
}

// The shapes, one after the other: cosines and sines of position, the same
// times the direction of motion, friction laws of other widths less the sign,
// five shapes of the load, random Fourier features of the state of the whole
// arm, the model's own torque (a wrong torque constant), and half cosines over
// each log's time, which are 0 in every other. All are of the order of 1.
MatrixXd Discrepancy::Torque(int j, const GapSegment& segment,
                             const RecordedTorque& torque) const {
  const Motion& motion = segment.motion;
  MatrixXd shapes =
      MatrixXd::Zero(motion.size(), kOfState + kTimeShapes * logs_);
  const ArrayXd turn = per_turn_[j] * motion.q.col(j).array();
  const ArrayXd speed = motion.qd.col(j).array();
  const double unit = per_turn_[j] == 1 ? 1 : .3;
  const ArrayXd sign = (speed / (kSignWidth * unit)).tanh();
  int at = 0;
  const auto add = [&](const ArrayXd& shape) { shapes.col(at++) = shape; };
  for (int k = 0; k < kHarmonics; ++k) {
    add((kHarmonicStep * (k + 1) * turn).cos());
    add((kHarmonicStep * (k + 1) * turn).sin());
  }
  for (int k = 0; k < kHarmonics; k += kSignStep) {
    add(shapes.col(2 * k).array() * sign);
    add(shapes.col(2 * k + 1).array() * sign);
  }
  for (const double share : kSpeedShares) {
    const double width = share * std::max(1e-3, scale_.top_speed[j]);
    add((speed / width).tanh() - sign);
  }
  const ArrayXd load =
      torque.load().col(j).array() / std::max(1e-9, scale_.torque[j]);
  add(load.tanh());
  add(load.abs() * sign);
  add(load * load.abs());
  add(load * sign.abs());
  add((3 * load).tanh());
  const ArrayXXd angle =
      (State(motion) * frequency_[j]).rowwise() + phase_[j].transpose();
  for (int k = 0; k < kStateShapes; ++k) {
    add(std::sqrt(2. / kStateShapes) * angle.col(k).cos());
  }
  add(torque.nominal().col(j).array() / std::max(1e-9, scale_.torque[j]));
  if (segment.log >= logs_) return shapes;
  const double length = std::max(1e-9, scale_.end - scale_.begin);
  const ArrayXd time = (ArrayXd::LinSpaced(motion.size(), motion.time(0),
                                           motion.time(motion.size() - 1)) -
                        scale_.begin) /
                       length;
  for (int k = 0; k < kTimeShapes; ++k) {
    shapes.col(kOfState + kTimeShapes * segment.log + k) =
        (M_PI * (k + 1) * time).cos();
  }
  return shapes;
}

}  // namespace armcal
