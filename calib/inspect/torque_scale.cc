#include "calib/inspect/torque_scale.h"

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "model/dynamics/inverse_dynamics.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd TorqueScale(const Robot& robot, const WiringSamples& samples) {
  constexpr double kTransition = .03;  // rad/s or m/s
  constexpr double kAlike = .7;
  constexpr double kHardlyAny = 1e-3;  // of the joint that needs most
  const Motion& motion = samples.motion;
  const int n = robot.num_joints();
  MatrixXd needed(motion.size(), n);
  for (int s = 0; s < motion.size(); ++s) {
    needed.row(s) = InverseDynamics(robot, motion.q.row(s), motion.qd.row(s),
                                    motion.qdd.row(s));
  }
  VectorXd scale =
      VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  const double most = needed.colwise().norm().maxCoeff();
  for (int j = 0; j < n; ++j) {
    if (!(needed.col(j).norm() > kHardlyAny * most)) continue;
    // What a joint at rest needs follows from the others' motion alone.
    if (!(motion.qd.col(j).norm() > kTransition * std::sqrt(motion.size()))) {
      continue;
    }
    MatrixXd others(motion.size(), 4);
    others << motion.qd.col(j),
        (motion.qd.col(j).array() / kTransition).tanh().matrix(),
        VectorXd::Ones(motion.size()), motion.qdd.col(j);
    const auto apart = others.colPivHouseholderQr();
    const VectorXd x = needed.col(j) - others * apart.solve(needed.col(j));
    const VectorXd y =
        samples.tau.col(j) - others * apart.solve(samples.tau.col(j));
    const double product = x.norm() * y.norm();
    if (product > 0 && std::abs(x.dot(y)) > kAlike * product) {
      scale[j] = x.dot(y) / x.squaredNorm();
    }
  }
  return scale;
}

}  // namespace armcal
