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

// v_s of a term of low speed, rad/s or m/s. A law of displacement has no width
// in speed: then those of common gears.
double SlowSpeed(const CoulombTransition& law, int index) {
  constexpr double kUsualWidth = .005;
  const double width =
      law.law == CoulombTransition::Law::kVelocity ? law.width : kUsualWidth;
  return (index == 0 ? 4 : 20) * width;
}

// How open the sign of friction is, 0 to 1. How Coulomb friction approaches its
// full size is a law of which tanh is one guess: others have algebraic tails,
// as v / sqrt(v^2 + w^2), whose 1 - c^2 this is.
double Openness(const CoulombTransition& law, double velocity, double c) {
  if (law.law == CoulombTransition::Law::kDisplacement) return 1 - c * c;
  const double ratio = velocity / law.width;
  return 1 / (1 + ratio * ratio);
}

}  // namespace

CausalRows::CausalRows(const WatchModel& model, double bandwidth_hz)
    : regressor_(model.parameters.MakeRegressor()),
      coulomb_(CoulombColumns(model.parameters)),
      states_(VectorXd::Zero(coulomb_.size())),
      c_(VectorXd::Zero(coulomb_.size())),
      open_(VectorXd::Zero(model.num_joints())),
      fast_position_(kFaster * kFaster * kTwoPi * bandwidth_hz),
      position_(kFaster * kTwoPi * bandwidth_hz),
      fast_torque_(fast_position_.poles()),
      raw_torque_(position_.poles()),
      raw_c_(position_.poles()),
      raw_slow_(position_.poles()),
      P_(kTwoPi * bandwidth_hz),
      D_(P_.poles()),
      torque_(P_.poles()),
      crossing_(P_.poles()),
      standing_(2 / kStandingTime),
      slow_(P_.poles()),
      slow_now_(MatrixXd::Zero(model.num_joints(), WatchModel::kSlowLaws)) {}

void CausalRows::Restart() { started_ = false; }

bool CausalRows::Add(double t, const VectorXd& q, const VectorXd& tau) {
  if (!started_) {
    begin_ = last_ = t;
    Start(q, tau);
    started_ = true;
    return false;
  }
  Follow(t - last_, q, tau);
  last_ = t;
  U_ = P_.rate() - D_.value();
  return t - begin_ > memory();
}

// Friction is a law of the velocity of the moment, which the filtered one is
// not: near a reversal it would turn too sharply. So it is that of a velocity
// filtered less, and then goes through the same filter as the torque. Its sign
// counts as open from the time on at which the filtered velocity, led by
// twice its delay, has passed zero.
void CausalRows::SetFriction(double h) {
  const VectorXd filtered = qd();
  const VectorXd lead =
      h > 0 ? VectorXd(filtered +
                       2 * position_.delay() / h * (filtered - last_velocity_))
            : filtered;
  last_velocity_ = filtered;
  const VectorXd velocity = fast_position_.rate();
  for (size_t k = 0; k < coulomb_.size(); ++k) {
    const int j = coulomb_[k].joint;
    const CoulombTransition& law = coulomb_[k].transition;
    states_[k] += h * law.StateRate(velocity[j], states_[k]);
    states_[k] = std::clamp(states_[k], -1., 1.);
    c_[k] = law.C(velocity[j], states_[k]);
    for (int s = 0; s < WatchModel::kSlowLaws; ++s) {
      slow_now_(j, s) =
          c_[k] * std::exp(-std::abs(velocity[j]) / SlowSpeed(law, s));
    }
    const bool turns = lead[j] * filtered[j] < 0;
    open_[j] = turns ? 1 : Openness(law, filtered[j], c_[k]);
  }
}

void CausalRows::Start(const VectorXd& q, const VectorXd& tau) {
  states_.setZero();
  fast_position_.Start(q);
  position_.Start(q);
  fast_torque_.Start(tau);
  raw_torque_.Start(tau);
  SetFriction(0);
  raw_c_.Start(c_);
  raw_slow_.Start(slow_now_);
  regressor_.Momentum(q, position_.rate(), c_, &P_now_, &D_now_);
  P_.Start(P_now_);
  D_.Start(D_now_);
  torque_.Start(tau);
  slow_.Start(slow_now_);
  crossing_.Start(open_);
  standing_.Start(open_);  // as it may have stood before
}

void CausalRows::Follow(double h, const VectorXd& q, const VectorXd& tau) {
  fast_position_.Step(h, q);
  position_.Step(h, fast_position_.value());
  fast_torque_.Step(h, tau);
  raw_torque_.Step(h, fast_torque_.value());
  SetFriction(h);
  raw_c_.Step(h, c_);
  raw_slow_.Step(h, slow_now_);
  regressor_.Momentum(position_.value(), position_.rate(), raw_c_.value(),
                      &P_now_, &D_now_);
  P_.Step(h, P_now_);
  D_.Step(h, D_now_);
  torque_.Step(h, raw_torque_.value());
  slow_.Step(h, raw_slow_.value());
  crossing_.Step(h, open_);
  standing_.Step(h, open_);
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
