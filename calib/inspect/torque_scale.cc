#include "calib/inspect/torque_scale.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "calib/numerics/median.h"
#include "model/dynamics/inverse_dynamics.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFrictionTurns = .03;  // rad/s or m/s
constexpr double kTorquesAlike = .7;
constexpr double kHardlyAnyTorque = 1e-3;  // of the joint that needs most
constexpr int kLeftOutParts = 8;
constexpr double kStudent = 2.36;  // 97.5 % of Student's t of 7 degrees

MatrixXd NeededTorques(const Robot& robot, const Motion& motion) {
  MatrixXd needed(motion.size(), robot.num_joints());
  for (int s = 0; s < motion.size(); ++s) {
    needed.row(s) = InverseDynamics(robot, motion.q.row(s), motion.qd.row(s),
                                    motion.qdd.row(s));
  }
  return needed;
}

// Weights of Huber's loss for what a slope leaves: 1 up to 1.345 standard
// deviations (1.4826 medians of its size, of a normal distribution).
VectorXd HuberWeights(const VectorXd& left) {
  std::vector<double> sizes(left.size());
  VectorXd::Map(sizes.data(), left.size()) = left.cwiseAbs();
  const double most = 1.345 * 1.4826 * Median(sizes) + 1e-300;
  return left.unaryExpr(
      [most](double x) { return std::min(1., most / std::abs(x)); });
}

// The line through 0 for y over x, and weights of its samples.
double RobustSlope(const VectorXd& x, const VectorXd& y, VectorXd* weights) {
  constexpr int kRounds = 5;
  *weights = VectorXd::Ones(x.size());
  double slope = 0;
  for (int round = 0; round < kRounds; ++round) {
    const VectorXd weighted = weights->cwiseProduct(x);
    slope = weighted.dot(y) / weighted.dot(x);
    *weights = HuberWeights(y - slope * x);
  }
  return slope;
}

// Half the width of the slope's 95 % interval: of m slopes b_k without part k,
// variance (m - 1) / m sum (b_k - mean b)^2.
double HalfWidth(const VectorXd& x, const VectorXd& y,
                 const VectorXd& weights) {
  const VectorXd xy = weights.cwiseProduct(x).cwiseProduct(y);
  const VectorXd xx = weights.cwiseProduct(x).cwiseProduct(x);
  Eigen::Array<double, kLeftOutParts, 1> slopes;
  for (int k = 0; k < kLeftOutParts; ++k) {
    const auto begin = k * x.size() / kLeftOutParts;
    const auto count = (k + 1) * x.size() / kLeftOutParts - begin;
    slopes[k] = (xy.sum() - xy.segment(begin, count).sum()) /
                (xx.sum() - xx.segment(begin, count).sum());
  }
  const double sum = (slopes - slopes.mean()).square().sum();
  return kStudent * std::sqrt(sum * (kLeftOutParts - 1) / kLeftOutParts);
}

// What a joint's torque holds besides the links': viscous and Coulomb friction,
// an offset and armature.
MatrixXd OwnTerms(const Motion& motion, int j) {
  MatrixXd terms(motion.size(), 4);
  terms << motion.qd.col(j),
      (motion.qd.col(j).array() / kFrictionTurns).tanh().matrix(),
      VectorXd::Ones(motion.size()), motion.qdd.col(j);
  return terms;
}

// Joint j's, from needed and recorded torques freed of its own terms; it stays
// NaN where these are not alike.
void Tell(int j, TorqueScales* scales) {
  const VectorXd x = scales->needed.col(j), y = scales->recorded.col(j);
  VectorXd weights;
  const double slope = RobustSlope(x, y, &weights);
  const VectorXd root = weights.cwiseSqrt();
  const double product =
      root.cwiseProduct(x).norm() * root.cwiseProduct(y).norm();
  const double common = std::abs(weights.cwiseProduct(x).dot(y));
  if (!(product > 0 && common > kTorquesAlike * product)) return;
  const double half = HalfWidth(x, y, weights);
  scales->scale[j] = slope;
  scales->low[j] = slope - half;
  scales->high[j] = slope + half;
}

}  // namespace

double TorqueScales::Size() const {
  std::vector<double> sizes;
  for (size_t j = 0; j < asked.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    const double size = recorded.col(column).norm();
    if (asked[j] && size > 0) {
      sizes.push_back(size / needed.col(column).norm());
    }
  }
  return sizes.empty() ? 0 : Median(sizes);
}

bool TorqueScales::AreOpposite() const {
  int count = 0;
  for (int j = 0; j < scale.size(); ++j) {
    if (!told(j)) continue;
    if (!(high[j] < 0)) return false;
    ++count;
  }
  return count > 1;
}

double TorqueScales::Left(int joint, double unit) const {
  const VectorXd y = recorded.col(joint) / unit;
  return (y - needed.col(joint)).norm() / y.norm();
}

TorqueScales TorqueScale(const Robot& robot, const WiringSamples& samples) {
  const Motion& motion = samples.motion;
  const int n = robot.num_joints();
  TorqueScales scales;
  scales.scale = scales.low = scales.high =
      VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  scales.needed = NeededTorques(robot, motion);
  scales.recorded = samples.tau;
  const VectorXd sizes = scales.needed.colwise().norm();
  for (int j = 0; j < n; ++j) {
    const MatrixXd own = OwnTerms(motion, j);
    const auto apart = own.colPivHouseholderQr();
    for (MatrixXd* torques : {&scales.needed, &scales.recorded}) {
      torques->col(j) -= own * apart.solve(torques->col(j)).eval();
    }
    // What a joint at rest needs follows from the others' motion alone.
    const bool moves =
        motion.qd.col(j).norm() > kFrictionTurns * std::sqrt(motion.size());
    scales.asked.push_back(moves &&
                           sizes[j] > kHardlyAnyTorque * sizes.maxCoeff());
    if (scales.asked[j]) Tell(j, &scales);
  }
  return scales;
}

}  // namespace armcal
