#include "calib/logs/wiring.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/dynamics/batch_regressor.h"
#include "problems/inertial_prior.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTransition = .03;  // rad/s or m/s, of Coulomb friction
constexpr double kLeastMass = 1e-3;  // kg, of a link whose file has none
constexpr int kTermsOfJoint = 4;     // viscous, Coulomb, offset, armature
// Of a joint's rms speed. Of a sine 9 % of the time is slower; between .1 and
// .3 the logs of ../shared/data are fitted alike well.
constexpr double kLeastSpeed = .2;
constexpr double kLeastShare = .01;  // of the torque: no model is better

// Torque of a unit of every link's inertial parameters and every joint's terms.
std::vector<MatrixXd> Columns(const Robot& robot, const Motion& motion) {
  const int n = robot.num_joints();
  std::vector<MatrixXd> columns(
      n, MatrixXd::Zero(motion.size(), 10 * n + kTermsOfJoint * n));
  std::vector<double*> links;  // of which joint i's torque has i and beyond
  for (int i = 0; i < n; ++i) links.push_back(&columns[i](0, 10 * i));
  BatchRegressor(robot).Differential(
      {motion.q, motion.qd, motion.qdd, MatrixXd()}, motion.size(),
      links.data(), motion.size());
  for (int i = 0; i < n; ++i) {
    MatrixXd own(motion.size(), kTermsOfJoint);
    own << motion.qd.col(i),
        (motion.qd.col(i).array() / kTransition).tanh().matrix(),
        VectorXd::Ones(motion.size()), motion.qdd.col(i);
    columns[i].middleCols(10 * n + kTermsOfJoint * i, kTermsOfJoint) = own;
  }
  return columns;
}

// Of `count` values that are not left out.
double RootMeanSquare(const VectorXd& x, double count) {
  return std::sqrt(x.squaredNorm() / std::max(1., count));
}

// 1 where a joint moves. Where it all but stands still its friction may be
// anything up to what breaks it loose, either way: no function of the motion,
// and of heavy arms the most of what a fit would leave.
MatrixXd MovingSamples(const Motion& motion) {
  MatrixXd moves(motion.qd.rows(), motion.qd.cols());
  for (Eigen::Index j = 0; j < moves.cols(); ++j) {
    const double rms = RootMeanSquare(motion.qd.col(j), motion.size());
    moves.col(j) =
        (motion.qd.col(j).array().abs() > kLeastSpeed * rms).cast<double>();
  }
  return moves;
}

// The columns of what is not negative. Viscous and Coulomb friction and
// armature take power; and of no body is the mass negative, nor a moment of
// inertia about an axis of its link's frame. A right reading needs none of
// that. Without it, torques that have the wrong sign are those of an arm whose
// bodies are negative, at a price of a few nats where the file's are small
// beside them.
std::vector<int> NotNegative(int n) {
  std::vector<int> columns;
  for (int j = 0; j < n; ++j) {
    for (const int k : {0, 4, 6, 9}) columns.push_back(10 * j + k);
    for (const int k : {0, 1, 3}) {
      columns.push_back(10 * n + kTermsOfJoint * j + k);
    }
  }
  return columns;
}

VectorXd SolveHeld(MatrixXd A, VectorXd b, const std::vector<bool>& held) {
  for (size_t c = 0; c < held.size(); ++c) {
    if (!held[c]) continue;
    A.row(c).setZero();
    A.col(c).setZero();
    A(c, c) = 1;
    b[c] = 0;
  }
  return A.ldlt().solve(b);
}

// The least x' A x / 2 - b' x where parameters that are `held` are zero and
// those of `not_negative` are not below zero: block principal pivoting
// (Portugal, Judice and Vicente 1994). Those that come out negative are held at
// zero, and those that are held are let go where the slope there, (A x - b)_c,
// is below zero, until none changes. That may cycle; then the last rounds only
// hold.
VectorXd SolveNotNegative(const MatrixXd& A, const VectorXd& b,
                          const std::vector<int>& not_negative,
                          const std::vector<bool>& held) {
  constexpr int kRounds = 8;
  std::vector<bool> zero = held;
  VectorXd x;
  for (int round = 0;; ++round) {
    x = SolveHeld(A, b, zero);
    const VectorXd slope = A * x - b;
    bool changed = false;
    for (const int c : not_negative) {
      if (held[c]) continue;
      const bool lets_go = zero[c] && slope[c] < 0 && round < kRounds;
      if (!lets_go && (zero[c] || !(x[c] < 0))) continue;
      zero[c] = !lets_go;
      changed = true;
    }
    if (!changed) return x;
  }
}

}  // namespace

Wiring::Wiring(int num_joints)
    : position_column(num_joints),
      torque_column(num_joints),
      position_sign(VectorXd::Ones(num_joints)),
      torque_sign(VectorXd::Ones(num_joints)) {
  std::iota(position_column.begin(), position_column.end(), 0);
  std::iota(torque_column.begin(), torque_column.end(), 0);
}

WiringSamples Rewired(const WiringSamples& samples, const Wiring& wiring) {
  WiringSamples joints = samples;
  for (size_t j = 0; j < wiring.position_column.size(); ++j) {
    const auto to = static_cast<Eigen::Index>(j);
    const int from = wiring.position_column[j];
    const double sign = wiring.position_sign[to];
    joints.motion.q.col(to) = sign * samples.motion.q.col(from);
    joints.motion.qd.col(to) = sign * samples.motion.qd.col(from);
    joints.motion.qdd.col(to) = sign * samples.motion.qdd.col(from);
    joints.tau.col(to) =
        wiring.torque_sign[to] * samples.tau.col(wiring.torque_column[j]);
  }
  return joints;
}

TorqueFit::TorqueFit(const Robot& robot, const Motion& motion)
    : columns_(Columns(robot, motion)), moves_(MovingSamples(motion)) {
  for (int j = 0; j < robot.num_joints(); ++j) {
    columns_[j].array().colwise() *= moves_.col(j).array();
  }
  const int n = robot.num_joints(), size = 10 * n + kTermsOfJoint * n;
  not_negative_ = NotNegative(n);
  for (const MatrixXd& columns : columns_) {
    MatrixXd square = MatrixXd::Zero(size, size);
    square.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
    squares_.emplace_back(square.selfadjointView<Eigen::Lower>());
  }
  nominal_ = VectorXd::Zero(size);
  prior_ = MatrixXd::Zero(size, size);
  for (int i = 0; i < n; ++i) {
    Vector10d V = robot.links[i].inertial.ToVector();
    if (!(V[0] > kLeastMass)) {
      V << kLeastMass, 0, 0, 0, 1e-6, 0, 1e-6, 0, 0, 1e-6;
    }
    const auto W = InertialPrior(V, 1).W();
    nominal_.segment<10>(10 * i) = V;
    prior_.block<10, 10>(10 * i, 10 * i) = W.transpose() * W;
  }
}

VectorXd TorqueFit::Solve(const MatrixXd& tau, const VectorXd& variance,
                          const std::vector<bool>& held) const {
  const auto n = static_cast<int>(columns_.size());
  MatrixXd A = prior_;
  VectorXd b = prior_ * nominal_;
  for (int j = 0; j < n; ++j) {
    const double weight = 1 / (variance[j] + 1e-18);
    A += weight * squares_[j];
    b += weight * columns_[j].transpose() * tau.col(j);
    // One term of a joint makes no more torque than the joint has: two that the
    // motion hardly tells apart, such as an offset and Coulomb friction of a
    // joint that goes one way, would cancel each other at a hundred times that
    // and leave it where the motion goes elsewhere. What does not move has a
    // value by next to nothing.
    const double samples = std::max(1., moves_.col(j).sum());
    const double rms = RootMeanSquare(tau.col(j), samples);
    const int own = 10 * n + kTermsOfJoint * j;
    A.diagonal().segment<kTermsOfJoint>(own).array() +=
        (squares_[j].diagonal().segment<kTermsOfJoint>(own).array() / samples +
         1e-4) /
        (rms * rms + 1e-12);
  }
  return SolveNotNegative(A, b, not_negative_, held);
}

TorqueFit::Fitted TorqueFit::FitTo(const MatrixXd& all) const {
  return FitTo(all, std::vector<bool>(nominal_.size(), false));
}

TorqueFit::Fitted TorqueFit::FitTo(const MatrixXd& all,
                                   std::vector<bool> held) const {
  constexpr int kRounds = 3;  // of the joints' noise
  const auto n = static_cast<int>(columns_.size());
  const MatrixXd tau = InMotion(all);
  const VectorXd samples = moves_.colwise().sum().cwiseMax(1);
  VectorXd variance(n);
  for (int j = 0; j < n; ++j)
    variance[j] = std::pow(.1 * RootMeanSquare(tau.col(j), samples[j]), 2);
  Fitted fitted;
  for (int round = 0; round < kRounds; ++round) {
    fitted.x = Solve(tau, variance, held);
    // A joint term that came out negative is not asked for again: one that
    // comes and goes from round to round makes what is left, over delays, jump.
    for (const int c : not_negative_) {
      if (c >= 10 * n && fitted.x[c] == 0) held[c] = true;
    }
    const VectorXd off = fitted.x - nominal_;
    fitted.misfit = .5 * off.dot(prior_ * off);
    fitted.squares = Squares(fitted.x, tau);
    for (int j = 0; j < n; ++j) {
      const double least =
          kLeastShare * RootMeanSquare(tau.col(j), samples[j]) + 1e-9;
      variance[j] = fitted.squares[j] / samples[j] + least * least;
      fitted.misfit += .5 * samples[j] * std::log(variance[j]);
    }
  }
  return fitted;
}

double TorqueFit::Misfit(const MatrixXd& tau, double* residual_percent) const {
  const Fitted fitted = FitTo(tau);
  if (residual_percent != nullptr) {
    *residual_percent =
        100 * std::sqrt(fitted.squares.sum()) / InMotion(tau).norm();
  }
  return fitted.misfit;
}

VectorXd TorqueFit::Parameters(const MatrixXd& tau) const {
  return FitTo(tau).x;
}

VectorXd TorqueFit::SquaresBesideNoBodies(const MatrixXd& tau) const {
  std::vector<bool> bodies(nominal_.size(), false);
  std::fill_n(bodies.begin(), 10 * columns_.size(), true);
  return FitTo(tau, bodies).squares;
}

VectorXd TorqueFit::SquaresBesideFile(const MatrixXd& tau) const {
  return SquaresBesideNoBodies(tau - Torque(nominal_));
}

MatrixXd TorqueFit::Torque(const VectorXd& parameters) const {
  const auto n = static_cast<Eigen::Index>(columns_.size());
  MatrixXd torque(columns_[0].rows(), n);
  for (Eigen::Index j = 0; j < n; ++j) {
    torque.col(j) = columns_[j] * parameters;
  }
  return torque;
}

VectorXd TorqueFit::Squares(const VectorXd& parameters,
                            const MatrixXd& tau) const {
  return (InMotion(tau) - Torque(parameters)).colwise().squaredNorm();
}

}  // namespace armcal
