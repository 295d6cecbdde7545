#include "model/dynamics/rigid_torque.h"

#include "model/dynamics/batch_inverse_dynamics.h"
#include "model/dynamics/forward_dynamics.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool SameLinks(const Robot& a, const Robot& b) {
  if (a.gravity != b.gravity || a.parents != b.parents) return false;
  for (int i = 0; i < a.num_joints(); ++i) {
    const Link &x = a.links[i], &y = b.links[i];
    const InertialParameters &u = x.inertial, &v = y.inertial;
    if (x.X_PF.matrix() != y.X_PF.matrix() ||
        x.X_ML.matrix() != y.X_ML.matrix() || u.mass != v.mass ||
        u.first_moment != v.first_moment || u.inertia != v.inertia) {
      return false;
    }
  }
  return true;
}

bool SameJointTerms(const Robot& a, const Robot& b) {
  for (int i = 0; i < a.num_joints(); ++i) {
    const Joint &x = a.links[i].joint, &y = b.links[i].joint;
    if (x.viscous != y.viscous || x.coulomb != y.coulomb ||
        x.armature != y.armature || x.offset != y.offset) {
      return false;
    }
  }
  return true;
}

MatrixXd LinkTorque(const Robot& robot, const MotionColumns& motion,
                    int samples) {
  MatrixXd tau(samples, robot.num_joints());
  std::vector<double*> to;
  for (int j = 0; j < tau.cols(); ++j) to.push_back(tau.col(j).data());
  BatchInverseDynamics(robot).Torque(motion, samples, to.data());
  return tau;
}

MatrixXd LinkTorque(const Robot& robot, const Motion& motion) {
  return LinkTorque(robot, {motion.q, motion.qd, motion.qdd, MatrixXd()},
                    motion.size());
}

LinkTorqueSlopes SlopesOfLinkTorque(const Robot& robot, const Motion& motion) {
  const int samples = motion.size(), n = motion.num_joints();
  LinkTorqueSlopes slopes = {MatrixXd(samples, n), MatrixXd(samples, n),
                             MatrixXd(samples, n)};
  // Differences: the torque is of second degree in the velocity, so that any
  // step is exact there; a position's is the cube root of what rounds.
  constexpr double kPositionStep = 1e-5, kVelocityStep = 1;
  Motion moved = motion;
  for (int j = 0; j < n; ++j) {
    const auto slope = [&](MatrixXd* signal, double step) -> VectorXd {
      const VectorXd as_it_was = signal->col(j);
      signal->col(j).array() = as_it_was.array() + step;
      const VectorXd above = LinkTorque(robot, moved).col(j);
      signal->col(j).array() = as_it_was.array() - step;
      const VectorXd below = LinkTorque(robot, moved).col(j);
      signal->col(j) = as_it_was;
      return (above - below) / (2 * step);
    };
    slopes.stiffness.col(j) = slope(&moved.q, kPositionStep);
    slopes.damping.col(j) = slope(&moved.qd, kVelocityStep);
  }
  for (int k = 0; k < samples; ++k) {
    slopes.inertia.row(k) = LinkInertias(robot, motion.q.row(k));
  }
  return slopes;
}

MatrixXd CoulombAlong(const std::vector<CoulombTransition>& transitions,
                      const Motion& motion) {
  std::vector<JointTermColumn> columns;
  for (int j = 0; j < motion.num_joints(); ++j) {
    columns.push_back({j, JointTerm::kCoulomb, transitions[j]});
  }
  Trajectory trajectory;
  trajectory.dt = motion.dt;
  trajectory.q = motion.q;
  trajectory.qd = motion.qd;
  return CoulombStates(columns).Follow(trajectory);
}

MatrixXd FrictionTorque(const Robot& robot, const Motion& motion,
                        const MatrixXd& coulomb) {
  MatrixXd tau(motion.size(), motion.num_joints());
  for (int j = 0; j < motion.num_joints(); ++j) {
    const Joint& joint = robot.links[j].joint;
    tau.col(j) = joint.viscous * motion.qd.col(j) +
                 joint.coulomb * coulomb.col(j) +
                 VectorXd::Constant(motion.size(), joint.offset);
  }
  return tau;
}

void AddArmature(const Robot& robot, const Motion& motion, MatrixXd* tau) {
  for (int j = 0; j < motion.num_joints(); ++j) {
    tau->col(j) += robot.links[j].joint.armature * motion.qdd.col(j);
  }
}

const MatrixXd& LinkTorques::Of(const Robot& robot) {
  if (SameLinks(robot, robot_)) return load_;
  for (const auto& [other, torque] : others_) {
    if (SameLinks(robot, *other)) return torque;
  }
  others_.emplace_back(&robot, LinkTorque(robot, motion_));
  return others_.back().second;
}

}  // namespace armcal
