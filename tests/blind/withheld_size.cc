#include "tests/blind/withheld_size.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Spreads of a model that a reference has yet to tell: ten times what the file
// says of the links, and friction of the order of all torque.
constexpr double kTrust = 10, kFrictionShare = .3, kArmatureShare = .1;
constexpr double kZeroVelocity = .006;  // rad/s
constexpr double kTiming = .05;         // s, of torques against positions
constexpr double kMoves = 2e-3;         // rad/s

MatrixXd Stacked(const MatrixXd& x) {
  return Eigen::Map<const MatrixXd>(x.data(), x.size(), 1);
}

VectorXd MovingRms(const MatrixXd& x, const MatrixXd& moves) {
  const VectorXd squares = (x.cwiseAbs2().cwiseProduct(moves)).colwise().sum();
  const VectorXd samples = moves.colwise().sum().cwiseMax(1);
  return squares.cwiseQuotient(samples).cwiseSqrt();
}

// Sets the spreads of friction and armature by the torques of the log.
void GiveFriction(const VectorXd& usual, Robot* robot) {
  for (int j = 0; j < robot->num_joints(); ++j) {
    Joint& joint = robot->links[j].joint;
    joint.coulomb = joint.viscous = kFrictionShare * usual[j];
    joint.armature = kArmatureShare * usual[j];
  }
}

}  // namespace

WithheldSizer::WithheldSizer(Robot robot, const Log& reference) {
  const Log uniform = UniformLog(reference);
  const int n = robot.num_joints();
  usual_ = MovingRms(uniform.tau, MatrixXd::Ones(uniform.tau.rows(), n));
  GiveFriction(usual_, &robot);
  model_.robot = robot;
  model_.trust = kTrust;
  model_.zero_velocity = kZeroVelocity;
  const Rows rows = RowsOf(uniform);
  const long size = rows.moves.rows();
  noise_rms_ = usual_;
  // Weights by what each fit leaves; the last one whitens as well.
  for (int round = 0; round < 3; ++round) {
    MatrixXd A = rows.columns, y = rows.torque;
    for (int j = 0; j < n; ++j) {
      const VectorXd weight = rows.moves.col(j) / noise_rms_[j];
      const auto part = Eigen::seqN(j * size, size);
      A(part, Eigen::all) = weight.asDiagonal() * A(part, Eigen::all);
      y(part, 0) = weight.cwiseProduct(y(part, 0));
    }
    fit_ = Absorption(A, {}).Coefficients(y.col(0), VectorXd::Zero(A.cols()));
    const VectorXd left = Residual(rows);
    const MatrixXd residual = Eigen::Map<const MatrixXd>(left.data(), size, n)
                                  .cwiseProduct(rows.moves);
    noise_rms_ = MovingRms(residual, rows.moves);
    noise_.clear();
    for (int j = 0; j < n; ++j) {
      noise_.push_back(ResidualNoise::Fit(residual.col(j)));
      // Standstill counted as silence.
      noise_[j].sigma *= std::sqrt(size / rows.moves.col(j).sum());
    }
  }
  const MatrixXd white = Whitened(rows, rows.columns);
  known_ = white.transpose() * white;
}

WithheldSizer::Rows WithheldSizer::RowsOf(const Log& uniform) const {
  const PlantMotion motion = RealMotion(uniform);
  Rows rows;
  rows.torque = Stacked(ThinTorque(
      uniform.tau -
          ModelTorque(model_.robot, ZeroVelocityWidths(model_), motion),
      motion.rate));
  rows.columns = AbsorbingColumns(model_, motion);
  rows.columns.rightCols(1) *= kTiming / kTimingSpread;
  const MatrixXd speed = ThinTorque(motion.qd, motion.rate).cwiseAbs();
  rows.moves = (speed.array() > kMoves).cast<double>();
  return rows;
}

MatrixXd WithheldSizer::Whitened(const Rows& rows, const MatrixXd& x) const {
  const long n = rows.moves.cols(), size = rows.moves.rows();
  const long left = size - ResidualNoise::kOrder;
  MatrixXd white(left * n, x.cols());
  for (int j = 0; j < n; ++j) {
    white.middleRows(j * left, left) =
        rows.moves.col(j).tail(left).asDiagonal() *
        noise_[j].Whiten(x.middleRows(j * size, size));
  }
  return white;
}

EffectSize WithheldSizer::Size(const WithheldEffect& effect,
                               const Log& uniform) {
  const Rows before = RowsOf(uniform);
  Rows after = RowsOf(WithEffect(model_.robot, effect, uniform));
  const VectorXd d = Residual(after) - Residual(before);
  return SizeOf(Whitened(before, d).col(0), before.moves.cols(),
                Absorption(Whitened(before, before.columns), known_));
}

}  // namespace armcal
