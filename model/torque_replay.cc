#include "model/torque_replay.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/forward_dynamics.h"

namespace armcal {
namespace {

using Eigen::VectorXd;
using Law = CoulombTransition::Law;

std::vector<JointTermColumn> CoulombColumns(
    const std::vector<CoulombTransition>& transitions) {
  std::vector<JointTermColumn> columns;
  for (size_t j = 0; j < transitions.size(); ++j) {
    columns.push_back(
        {static_cast<int>(j), JointTerm::kCoulomb, transitions[j]});
  }
  return columns;
}

}  // namespace

TorqueReplay::TorqueReplay(const Robot& robot,
                           std::vector<CoulombTransition> transitions,
                           ArmDynamics* dynamics)
    : robot_(robot),
      transitions_(std::move(transitions)),
      dynamics_(dynamics),
      coulomb_(CoulombColumns(transitions_)) {
  CHECK_EQ(robot.num_joints(), dynamics->num_joints());
  CHECK_EQ(robot.num_joints(), static_cast<int>(transitions_.size()));
}

double TorqueReplay::Friction(int j, double qd, double c) const {
  const Joint& joint = robot_.links[j].joint;
  if (transitions_[j].law == Law::kVelocity) {
    c = std::tanh(qd / transitions_[j].width);
  }
  return joint.viscous * qd + joint.coulomb * std::clamp(c, -1.0, 1.0) +
         joint.offset;
}

void TorqueReplay::Rate(const VectorXd& tau, const VectorXd& x,
                        VectorXd* rate) {
  const int n = num_joints();
  const VectorXd q = x.head(n), qd = x.segment(n, n);
  dynamics_->Evaluate(q, qd, {}, &terms_);
  VectorXd net = tau - terms_.bias;
  for (int j = 0; j < n; ++j) {
    const double c = x[2 * n + j];
    net[j] -= Friction(j, qd[j], c);
    terms_.mass_matrix(j, j) += robot_.links[j].joint.armature;
    // A Prandtl element that has yielded stays where it is.
    const bool yields = std::abs(c) >= 1 && c * qd[j] > 0;
    const bool moves = transitions_[j].law == Law::kDisplacement && !yields;
    (*rate)[2 * n + j] = moves ? qd[j] / transitions_[j].width : 0;
  }
  rate->head(n) = qd;
  rate->segment(n, n) = SolveInertia(terms_.mass_matrix, net);
}

Integration TorqueReplay::Run(const Trajectory& trajectory, int first, int last,
                              const VectorXd& coulomb,
                              const IntegrationOptions& options) {
  CHECK(0 <= first && first < last && last < trajectory.size());
  const int n = num_joints();
  VectorXd x0(3 * n);
  x0 << trajectory.q.row(first).transpose(),
      trajectory.qd.row(first).transpose(), coulomb;
  std::vector<double> times;  // s since row `first`
  for (int k = first + 1; k <= last; ++k) {
    times.push_back((k - first) * trajectory.dt);
  }
  return Integrate(
      [&](double t, const VectorXd& x, VectorXd* rate) {
        const double at = first + t / trajectory.dt;
        const int k = std::clamp(static_cast<int>(at), first, last - 1);
        const VectorXd tau = (1 - (at - k)) * trajectory.tau.row(k) +
                             (at - k) * trajectory.tau.row(k + 1);
        Rate(tau, x, rate);
      },
      x0, 0, times, options);
}

}  // namespace armcal
