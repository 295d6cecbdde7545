#include "model/dynamics/torque_replay.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/dynamics/batch_torque_replay.h"
#include "model/dynamics/forward_dynamics.h"

namespace armcal {
namespace {

// Far beyond what a simulation in use leaves, and near enough that an arm that
// runs away is not followed in ever smaller steps.
constexpr double kLostAngle = 100;  // rad
constexpr double kLostLength = 10;  // m

using Eigen::VectorXd;

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

bool TorqueReplay::IsLost(const VectorXd& recorded, const VectorXd& x) const {
  for (int j = 0; j < num_joints(); ++j) {
    const bool turns = IsRotational(robot_.links[j].joint.type);
    if (std::abs(x[j] - recorded[j]) >= (turns ? kLostAngle : kLostLength)) {
      return true;
    }
  }
  return false;
}

void TorqueReplay::Rate(const VectorXd& tau, const VectorXd& x,
                        VectorXd* rate) {
  const int n = num_joints();
  const VectorXd q = x.head(n), qd = x.segment(n, n);
  dynamics_->Evaluate(q, qd, {}, &terms_);
  VectorXd net = tau - terms_.bias;
  for (int j = 0; j < n; ++j) {
    const Joint& joint = robot_.links[j].joint;
    const double c = x[2 * n + j];
    net[j] -= FrictionTorque(joint, transitions_[j], qd[j], c);
    terms_.mass_matrix(j, j) += joint.armature;
    (*rate)[2 * n + j] = transitions_[j].StateRate(qd[j], c);
  }
  rate->head(n) = qd;
  rate->segment(n, n) = SolveInertia(terms_.mass_matrix, net);
}

// Integrates (q, qd, states of Coulomb friction) from row `first` under the
// recorded torque, linear between rows.
Integration TorqueReplay::Run(const Trajectory& trajectory, int first, int last,
                              const VectorXd& coulomb,
                              const IntegrationOptions& given) {
  CHECK(0 <= first && first < last && last < trajectory.size());
  const int n = num_joints();
  VectorXd x0(3 * n);
  x0 << trajectory.q.row(first).transpose(),
      trajectory.qd.row(first).transpose(), coulomb;
  std::vector<double> times;  // s since row `first`
  for (int k = first + 1; k <= last; ++k) {
    times.push_back((k - first) * trajectory.dt);
  }
  const auto recorded = [&](const Eigen::MatrixXd& rows, double t) -> VectorXd {
    const double at = first + t / trajectory.dt;
    const int k = std::clamp(static_cast<int>(at), first, last - 1);
    return (1 - (at - k)) * rows.row(k) + (at - k) * rows.row(k + 1);
  };
  IntegrationOptions options = given;
  options.is_lost = [&](double t, const VectorXd& x) {
    return IsLost(recorded(trajectory.q, t), x);
  };
  return Integrate(
      [&](double t, const VectorXd& x, VectorXd* rate) {
        Rate(recorded(trajectory.tau, t), x, rate);
      },
      x0, 0, times, options);
}

}  // namespace armcal
