#include "calib/logs/velocity_law.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "calib/logs/stamp_hole.h"
#include "calib/numerics/median.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Beyond it qd is of another unit or joint: the channel audit says so.
constexpr double kLeastVelocityGain = .7, kMostVelocityGain = 1.4;
// Of frequency times delay. The series for a late velocity ends after its
// second order; what it leaves out is of this size to the third power over 6,
// 2e-4 of the velocity at .1, far below the 1 % that a clock is blamed for.
constexpr double kMostPhase = .1;

double RmsOf(const VectorXd& x) {
  return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

// Of the difference quotient's rms. A velocity that is closer to it was made
// from the positions by the stamps, or agrees with both.
constexpr double kDerived = .01;

// Whether qd of a row is the difference quotient to the row before or after.
bool IsDerived(const VectorXd& dt, const VectorXd& qd, const VectorXd& dq) {
  const Eigen::Index size = dt.size();
  const double least = kDerived * dq.norm();
  return (dq - dt.cwiseProduct(qd.tail(size))).norm() < least ||
         (dq - dt.cwiseProduct(qd.head(size))).norm() < least;
}

// Steps across a hole of the stamps, and those beside: over that time a
// velocity is not the mean of its ends.
std::vector<Eigen::Index> StepsAtHoles(const VectorXd& dt) {
  const std::vector<double> steps(dt.data(), dt.data() + dt.size());
  const double usual = Quantile(steps, .5);
  std::vector<Eigen::Index> found;
  for (Eigen::Index k = 0; k < dt.size(); ++k) {
    for (Eigen::Index i = std::max<Eigen::Index>(0, k - 1);
         i <= std::min(dt.size() - 1, k + 1); ++i) {
      if (!IsHole(dt[i], usual)) continue;
      found.push_back(k);
      break;
    }
  }
  return found;
}

// Steps `without` tell nothing: they are 0 in all.
VelocityLaw FitLaw(const VectorXd& dt, const VectorXd& v, const VectorXd& dq,
                   const std::vector<Eigen::Index>& without, VectorXd* change) {
  const Eigen::Index size = v.size();
  MatrixXd columns = MatrixXd::Zero(size, 3);
  columns.col(0) = v.cwiseProduct(dt);
  // Central differences of v over the steps beside: a dt and j dt. The latter
  // goes as v itself where the motion is a sine's, and is over the usual step:
  // over the step's own it would undo the errors of that in v dt.
  const double usual =
      Quantile(std::vector<double>(dt.data(), dt.data() + size), .5);
  for (Eigen::Index k = 1; k + 1 < size; ++k) {
    const double around = .5 * (dt[k - 1] + dt[k + 1]) + dt[k];
    if (!(around > 0) || !(dt[k] > 0) || !(usual > 0)) continue;
    columns(k, 1) = (v[k + 1] - v[k - 1]) * dt[k] / around;
    columns(k, 2) = (v[k + 1] - 2 * v[k] + v[k - 1]) * dt[k] / (usual * usual);
  }
  for (const Eigen::Index k : without) columns.row(k).setZero();
  VelocityLaw law;
  *change = dq;
  Vector3d scale = columns.colwise().norm();
  if (!(scale.minCoeff() > 0)) return law;
  const MatrixXd unit = columns * scale.cwiseInverse().asDiagonal();
  const Matrix3d normal = unit.transpose() * unit;
  const Vector3d x =
      normal.ldlt().solve(unit.transpose() * dq).cwiseQuotient(scale);
  *change -= columns.rightCols(2) * x.tail(2);
  law.gain = x[0];
  law.delay = x[1];
  law.frequency = RmsOf(columns.col(1)) / RmsOf(columns.col(0));
  law.correlation = columns.col(0).dot(dq) / (scale[0] * dq.norm() + 1e-300);
  law.usable = law.gain > kLeastVelocityGain && law.gain < kMostVelocityGain &&
               std::abs(law.delay) * law.frequency < kMostPhase;
  return law;
}

}  // namespace

VelocitySteps FitVelocityLaws(const Log& log) {
  const Eigen::Index steps = log.size() - 1, joints = log.q.cols();
  VelocitySteps all;
  all.dt = log.t.tail(steps) - log.t.head(steps);
  all.v = .5 * (log.qd.topRows(steps) + log.qd.bottomRows(steps));
  all.change.resize(steps, joints);
  const std::vector<Eigen::Index> without = StepsAtHoles(all.dt);
  for (Eigen::Index j = 0; j < joints; ++j) {
    VectorXd dq = log.q.col(j).tail(steps) - log.q.col(j).head(steps);
    for (const Eigen::Index k : without) dq[k] = 0;
    VectorXd change;
    all.laws.push_back(FitLaw(all.dt, all.v.col(j), dq, without, &change));
    VelocityLaw& law = all.laws.back();
    law.derived = IsDerived(all.dt, log.qd.col(j), dq);
    law.usable = law.usable && !law.derived;
    all.change.col(j) = change;
  }
  for (const Eigen::Index k : without) all.v.row(k).setZero();
  for (Eigen::Index k = 0; k < steps; ++k) {
    all.still.push_back(log.q.row(k) == log.q.row(k + 1));
  }
  return all;
}

}  // namespace armcal
