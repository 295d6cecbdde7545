#include "model/stage_stepper.h"

#include <glog/logging.h>

#include <algorithm>
#include <limits>

#include "model/forward_dynamics.h"
#include "model/joint_term.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kNode[] = {0, .5, .5, 1};
constexpr double kWeight[] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
// Beyond these a state is of no use: rad or m, rad/s or m/s.
constexpr double kLostPosition = 1e5, kLostVelocity = 1e7;

}  // namespace

void StageMotion::Resize(long steps, int n) {
  for (Eigen::MatrixXd* x : {&q, &qd, &qdd}) x->resize(kStages * steps, n);
}

StageStepper::StageStepper(const RolloutArm& arm, const simd::Kernels& kernels)
    : arm_(arm),
      plan_(std::make_shared<ArmPlan>(arm, kernels.one_arm.lanes)),
      kernels_(&kernels.one_arm) {
  CHECK(arm.springs.empty());
  const int n = plan_->num_joints();
  arm_.transitions.resize(n);
  for (const CoulombTransition& transition : arm_.transitions) {
    CHECK(transition.law == CoulombTransition::Law::kVelocity);
  }
  SetState(VectorXd::Zero(n), VectorXd::Zero(n));
  stage_q_ = stage_qd_ = rate_ = tau_ = sum_q_ = sum_qd_ = q_;
}

void StageStepper::SetState(const VectorXd& q, const VectorXd& qd) {
  CHECK(q.size() == plan_->num_joints() && qd.size() == q.size());
  q_ = q;
  qd_ = qd;
}

bool StageStepper::Advance(double step, const Eigen::MatrixXd& torque, long row,
                           StageMotion* kept) {
  const int n = num_joints();
  sum_q_.setZero();
  sum_qd_.setZero();
  for (int i = 0; i < StageMotion::kStages; ++i) {
    if (i == 0) {
      stage_q_ = q_;
      stage_qd_ = qd_;
    } else {
      stage_q_ = q_ + kNode[i] * step * stage_qd_;
      stage_qd_ = qd_ + kNode[i] * step * rate_;
    }
    for (int j = 0; j < n; ++j) {
      tau_[j] = torque(j, (i + 1) / 2) -
                FrictionTorque(arm_.robot.links[j].joint, arm_.transitions[j],
                               stage_qd_[j], 0);
    }
    kernels_->acceleration(plan_->constants(), stage_q_.data(),
                           stage_qd_.data(), tau_.data(), 1, rate_.data());
    sum_q_ += kWeight[i] * stage_qd_;
    sum_qd_ += kWeight[i] * rate_;
    if (kept == nullptr) continue;
    kept->q.row(row + i) = stage_q_;
    kept->qd.row(row + i) = stage_qd_;
    kept->qdd.row(row + i) = rate_;
  }
  q_ += step * sum_q_;
  qd_ += step * sum_qd_;
  return q_.cwiseAbs().maxCoeff() < kLostPosition &&
         qd_.cwiseAbs().maxCoeff() < kLostVelocity;
}

double StageStepper::SafeStep(const VectorXd& q) const {
  // Of the time constant with which friction alone stops a joint: explicit
  // steps are stable up to 2.7 of it.
  constexpr double kOfTimeConstant = .7;
  Eigen::MatrixXd M = MassMatrix(arm_.robot, q);
  for (int j = 0; j < num_joints(); ++j) {
    M(j, j) += arm_.robot.links[j].joint.armature;
  }
  double fastest = 0;
  for (int j = 0; j < num_joints(); ++j) {
    const Joint& joint = arm_.robot.links[j].joint;
    const double slope =
        joint.viscous + joint.coulomb / arm_.transitions[j].width;
    const VectorXd unit = VectorXd::Unit(num_joints(), j);
    fastest += slope * SolveInertia(M, unit)[j];
  }
  return fastest > 0 ? kOfTimeConstant / fastest
                     : std::numeric_limits<double>::infinity();
}

}  // namespace armcal
