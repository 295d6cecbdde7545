#include "model/plant/steady_loop.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "model/dynamics/drive_filters.h"
#include "model/dynamics/forward_dynamics.h"
#include "model/plant/robot_variation.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPostures = 48;
constexpr double kGainMargin = 2;

// Mass matrices at postures of the motion, armature included.
std::vector<MatrixXd> InertiasAlong(const Robot& robot,
                                    const ReferenceMotion& motion) {
  Robot possible = robot;
  MakeLinksPossible(&possible);
  std::vector<MatrixXd> inertias;
  for (int k = 0; k <= kPostures; ++k) {
    inertias.push_back(
        MassMatrix(possible, motion.at(motion.duration * k / kPostures).q));
    for (int j = 0; j < robot.num_joints(); ++j) {
      inertias.back()(j, j) += robot.links[j].joint.armature;
    }
  }
  return inertias;
}

struct Gains {
  VectorXd kp, kd, ki;
};

Gains Scaled(const ControllerOptions& controller, double factor) {
  const Eigen::Index n = controller.drives.size();
  Gains gains{VectorXd(n), VectorXd(n), VectorXd(n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    gains.kp[j] = factor * controller.drives[j].kp;
    gains.kd[j] = factor * controller.drives[j].kd;
    gains.ki[j] = factor * controller.drives[j].ki;
  }
  return gains;
}

// What one control period makes of a deviation from rest: of position,
// velocity, the position before, the filtered velocity, the integral of the
// position (n each).
MatrixXd PeriodMatrix(const MatrixXd& inertia, const Gains& gains,
                      const ControllerOptions& controller) {
  const Eigen::Index n = inertia.rows();
  const double T = 1 / controller.rate_hz;
  const double decay =
      LowPassDecay(controller.velocity_filter_hz, controller.rate_hz);
  const MatrixXd one = MatrixXd::Identity(n, n);
  MatrixXd filtered = MatrixXd::Zero(n, 5 * n), integral = filtered;
  filtered.leftCols(n) = (1 - decay) / T * one;
  filtered.middleCols(2 * n, n) = -(1 - decay) / T * one;
  filtered.middleCols(3 * n, n) = decay * one;
  integral.rightCols(n) = one;
  MatrixXd torque = -(gains.kd.asDiagonal() * filtered);
  torque.leftCols(n) -= MatrixXd(gains.kp.asDiagonal());
  torque.rightCols(n) -= MatrixXd(gains.ki.asDiagonal());
  const MatrixXd acceleration = inertia.llt().solve(torque);
  MatrixXd period = MatrixXd::Zero(5 * n, 5 * n);
  period.topRows(n) = T * T / 2 * acceleration;
  period.topLeftCorner(n, n) += one;
  period.block(0, n, n, n) += T * one;
  period.middleRows(n, n) = T * acceleration;
  period.block(n, n, n, n) += one;
  period.block(2 * n, 0, n, n) = one;
  period.middleRows(3 * n, n) = filtered;
  period.bottomRows(n) = integral;
  period.bottomLeftCorner(n, n) = T * one;
  return period;
}

bool IsStableAt(const std::vector<MatrixXd>& inertias,
                const ControllerOptions& controller, double factor) {
  const Gains gains = Scaled(controller, factor);
  return std::all_of(inertias.begin(), inertias.end(),
                     [&](const MatrixXd& inertia) {
                       const Eigen::EigenSolver<MatrixXd> modes(
                           PeriodMatrix(inertia, gains, controller), false);
                       return modes.info() == Eigen::Success &&
                              modes.eigenvalues().cwiseAbs().maxCoeff() < 1;
                     });
}

// The largest kd over inertia of a single joint that is stable, 1/s, with as
// much of kp and ki beside it as DefaultController gives.
double LargestDamping(const ControllerOptions& controller) {
  const std::vector<MatrixXd> one = {MatrixXd::Identity(1, 1)};
  ControllerOptions single = controller;
  single.drives.resize(1);
  DriveLaw& law = single.drives[0];
  law.kp /= law.kd;
  law.ki /= law.kd;
  law.kd = 1;
  double low = 0, high = controller.rate_hz;
  while (IsStableAt(one, single, high)) high *= 2;
  constexpr int kHalvings = 30;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    (IsStableAt(one, single, middle) ? low : high) = middle;
  }
  return low;
}

// The mode that is damped the fastest along the motion.
struct FastestMode {
  double damping = 0;  // eigenvalue of M^-1 diag(kd), 1/s
  int joint = 0;       // with the largest part of it
};

FastestMode FastestOf(const std::vector<MatrixXd>& inertias,
                      const VectorXd& kd) {
  FastestMode fastest;
  for (const MatrixXd& inertia : inertias) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(
        MatrixXd(kd.asDiagonal()), inertia);
    const Eigen::Index last = kd.size() - 1;
    if (modes.eigenvalues()[last] <= fastest.damping) continue;
    fastest.damping = modes.eigenvalues()[last];
    const VectorXd part =
        kd.cwiseProduct(modes.eigenvectors().col(last).cwiseAbs2());
    part.maxCoeff(&fastest.joint);
  }
  return fastest;
}

}  // namespace

bool IsStable(const Robot& robot, const ControllerOptions& controller,
              const ReferenceMotion& motion, double factor) {
  return IsStableAt(InertiasAlong(robot, motion), controller, factor);
}

ControllerOptions SteadyController(const Robot& robot,
                                   const ReferenceMotion& motion,
                                   double bandwidth_hz) {
  constexpr double kStep = .8;
  ControllerOptions controller =
      DefaultController(robot, motion.at(0).q, bandwidth_hz);
  const std::vector<MatrixXd> inertias = InertiasAlong(robot, motion);
  const double most = LargestDamping(controller) / kGainMargin;
  while (true) {
    const FastestMode fastest = FastestOf(inertias, Scaled(controller, 1).kd);
    if (!(fastest.damping > most)) break;
    controller.drives[fastest.joint].kp *= kStep;
    controller.drives[fastest.joint].kd *= kStep;
  }
  for (int j = 0; j < robot.num_joints(); ++j) {
    double largest = 0;
    for (const MatrixXd& inertia : inertias) {
      largest = std::max(largest, inertia(j, j));
    }
    DriveLaw& law = controller.drives[j];
    law.ki = std::min(law.ki, law.kp * law.kd / (8 * largest));
  }
  return controller;
}

}  // namespace armcal
