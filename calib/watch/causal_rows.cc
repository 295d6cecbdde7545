#include "calib/watch/causal_rows.h"

#include <algorithm>

#include "model/robot/kinematics.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kTwoPi = 6.283185307179586;
// The positions' filter is so many times faster than that of the equations: it
// adds little to the delay, and its two poles and F's outweigh the s^2 with
// which noise of positions grows.
constexpr double kFaster = 2.5;
// After so many time constants a two-pole filter has forgotten its start to
// (1 + 12) exp(-12) = 8e-5.
constexpr double kForgotten = 12;
// What is called standing, s; passing through zero takes a twentieth of it.
constexpr double kStandingTime = .4;

std::vector<JointTermColumn> CoulombColumns(const ModelParameters& model) {
  std::vector<JointTermColumn> columns;
  for (const ModelParameter& p : model.parameters()) {
    if (!p.is_joint_term || p.term != JointTerm::kCoulomb) continue;
    columns.push_back({p.block, p.term, p.transition});
  }
  return columns;
}

}  // namespace

CausalRows::CausalRows(const WatchModel& model, double bandwidth_hz)
    : regressor_(model.parameters.MakeRegressor()),
      coulomb_(CoulombColumns(model.parameters)),
      states_(VectorXd::Zero(coulomb_.size())),
      c_(VectorXd::Zero(coulomb_.size())),
      open_(VectorXd::Zero(model.num_joints())),
      position_(kFaster * kTwoPi * bandwidth_hz),
      raw_torque_(position_.poles()),
      P_(kTwoPi * bandwidth_hz),
      D_(P_.poles()),
      torque_(P_.poles()),
      crossing_(P_.poles()),
      standing_(2 / kStandingTime) {}

void CausalRows::Restart() { started_ = false; }

bool CausalRows::Add(double t, const VectorXd& q, const VectorXd& tau) {
  if (!started_) {
    begin_ = last_ = t;
    states_.setZero();
    position_.Start(q);
    raw_torque_.Start(tau);
    Follow(0, q, tau);
    started_ = true;
    return false;
  }
  Follow(t - last_, q, tau);
  last_ = t;
  U_ = P_.rate() - D_.value();
  return t - begin_ > kForgotten * delay() / 2;
}

// The torque of friction turns when the joint does, which the filtered velocity
// shows later and more gently: the sign is open from the time on at which the
// velocity, led by twice that delay, has passed zero.
void CausalRows::SetFriction(double h) {
  const VectorXd velocity = qd();
  if (h > 0) {
    lead_ = velocity + 2 * position_.delay() / h * (velocity - velocity_);
  } else {
    lead_ = velocity;
  }
  velocity_ = velocity;
  for (size_t k = 0; k < coulomb_.size(); ++k) {
    const int j = coulomb_[k].joint;
    const CoulombTransition& law = coulomb_[k].transition;
    states_[k] += h * law.StateRate(velocity[j], states_[k]);
    states_[k] = std::clamp(states_[k], -1., 1.);
    c_[k] = law.C(velocity[j], states_[k]);
    const bool turns = lead_[j] * velocity[j] < 0;
    open_[j] = turns ? 1 : 1 - c_[k] * c_[k];
  }
}

void CausalRows::Follow(double h, const VectorXd& q, const VectorXd& tau) {
  if (h > 0) {
    position_.Step(h, q);
    raw_torque_.Step(h, tau);
  }
  SetFriction(h);
  regressor_.Momentum(position_.value(), position_.rate(), c_, &P_now_,
                      &D_now_);
  if (h > 0) {
    P_.Step(h, P_now_);
    D_.Step(h, D_now_);
    torque_.Step(h, raw_torque_.value());
    crossing_.Step(h, open_);
    standing_.Step(h, open_);
  } else {
    P_.Start(P_now_);
    D_.Start(D_now_);
    torque_.Start(tau);
    crossing_.Start(open_);
    standing_.Start(VectorXd::Zero(open_.size()));
  }
}

MatrixXd WrenchColumns(const Robot& robot, const VectorXd& q) {
  const auto X_WL = LinkPoses(robot, q);
  const int n = robot.num_joints();
  const Vector3d at = X_WL[n - 1].translation();
  MatrixXd columns = MatrixXd::Zero(n, 6);
  for (int k = n - 1; k >= 0; k = robot.parent(k)) {
    const int parent = robot.parent(k);
    Eigen::Isometry3d X_WF = robot.links[k].X_PF;
    if (parent >= 0) X_WF = X_WL[parent] * X_WF;
    const Vector3d z = X_WF.linear().col(2);
    if (IsRotational(robot.links[k].joint.type)) {
      columns.block<1, 3>(k, 0) = -z.cross(at - X_WF.translation()).transpose();
      columns.block<1, 3>(k, 3) = -z.transpose();
    } else {
      columns.block<1, 3>(k, 0) = -z.transpose();
    }
  }
  return columns;
}

}  // namespace armcal
