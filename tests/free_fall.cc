#include "tests/free_fall.h"

#include <glog/logging.h>

#include "model/forward_dynamics.h"
#include "model/integration.h"
#include "tests/benchmark_log.h"

namespace armcal {

using Eigen::VectorXd;

FreeFall::FreeFall() : robot(BenchmarkRobot()) {
  for (Link& link : robot.links) {
    link.joint.viscous = link.joint.coulomb = link.joint.armature = 0;
  }
  const Log log = BenchmarkLog(robot, 2);
  q = log.q.row(0);
  qd = log.qd.row(0);
}

VectorXd FreeFall::ExactEnd() const {
  const int n = robot.num_joints();
  VectorXd x0(2 * n);
  x0 << q, qd;
  IntegrationOptions options;
  options.relative = options.absolute = 1e-13;
  const Integration fall = Integrate(
      [&](double, const VectorXd& x, VectorXd* rate) {
        *rate << x.tail(n),
            ForwardDynamics(robot, x.head(n), x.tail(n), VectorXd::Zero(n));
      },
      x0, 0, {kSteps * kStep}, options);
  CHECK(fall.finished) << fall.reason;
  return fall.x.row(0).head(n).transpose();
}

double FreeFall::Error(const VectorXd& q_end) const {
  return (q_end - ExactEnd()).lpNorm<Eigen::Infinity>();
}

}  // namespace armcal
