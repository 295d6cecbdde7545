#include "tests/free_fall.h"

#include "model/rigid_arm.h"
#include "tests/benchmark_log.h"
#include "tests/exact_rollout.h"

namespace armcal {

using Eigen::VectorXd;

FreeFall::FreeFall(double viscous) : robot(BenchmarkRobot()) {
  for (Link& link : robot.links) {
    Joint& joint = link.joint;
    joint.coulomb = joint.armature = joint.offset = 0;
    joint.viscous = viscous;
  }
  const Log log = BenchmarkLog(robot, 2);
  q = log.q.row(0);
  qd = log.qd.row(0);
}

double FreeFall::Error(const VectorXd& q_end) const {
  const int n = robot.num_joints();
  RigidArm engine(robot);
  const VectorXd exact = ExactEnd({robot, {}, {}}, q, qd, VectorXd::Zero(n),
                                  kSteps * kStep, &engine);
  return (q_end - exact.head(n)).lpNorm<Eigen::Infinity>();
}

}  // namespace armcal
