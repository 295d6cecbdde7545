#include "model/plant/arm_simulator.h"

#include <glog/logging.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "model/plant/interpolated_terms.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Friction that changes sign takes as many, or an arm that no feedback holds
// (a motor at its limit) is off by more than 3e-7 rad after 2 s.
constexpr int kFewestSubsteps = 6;
constexpr int kMostSubsteps = 64;
// Of steps that are implicit in friction.
constexpr int kImplicitSubsteps = 16;

}  // namespace

ArmSimulator::ArmSimulator(const SimulatedRobot& robot, const VectorXd& q0,
                           const ArmSimulatorOptions& options,
                           ArmDynamics* dynamics)
    : robot_(robot),
      dynamics_(dynamics),
      step_(options.step),
      begin_time_(options.begin),
      n_(robot.robot.num_joints()),
      layout_(robot) {
  CHECK_EQ(dynamics->num_joints(), n_);
  CHECK_EQ(q0.size(), n_);
  CHECK_GT(step_, 0);
  CHECK(robot.thermal.empty() ||
        robot.thermal.size() == static_cast<size_t>(n_));
  SetArmature();
  for (const WrenchLaw& law : robot.wrenches) {
    attachments_.push_back(law.attachment);
  }
  dynamics->Evaluate(q0, VectorXd::Zero(n_), attachments_, &end_);
  begin_ = middle_ = end_;
  x_ = layout_.StateAtRest(robot, q0, end_);
  instant_.load = end_.bias;
  qdd_ = jerk_ = commanded_ = VectorXd::Zero(n_);
  ReadInstant(x_, begin_time_);
  substeps_ = options.substeps > 0 ? options.substeps : NeededSubsteps();
}

void ArmSimulator::SetMotors(const VectorXd& q, const VectorXd& qd) {
  CHECK(q.size() == n_ && qd.size() == n_);
  VectorXd link_q = q, link_qd = qd;
  for (size_t k = 0; k < robot_.transmissions.size(); ++k) {
    const int j = robot_.transmissions[k].joint;
    const auto motor = x_.segment<2>(layout_.motors + 2 * k);
    link_q[j] = step_index_ == 0 ? q[j] - (motor[0] - x_[j]) : x_[j];
    if (step_index_ > 0) link_qd[j] = x_[n_ + j];
    x_.segment<2>(layout_.motors + 2 * k) << q[j], qd[j];
  }
  x_.head(2 * n_) << link_q, link_qd;
  dynamics_->Evaluate(link_q, link_qd, attachments_, &end_);
  ReadInstant(x_, instant_.t);
}

void ArmSimulator::SetArmature() {
  armature_.resize(n_);
  for (int j = 0; j < n_; ++j) {
    armature_[j] = robot_.robot.links[j].joint.armature;
  }
  rigid_armature_ = armature_;
  for (const Transmission& transmission : robot_.transmissions) {
    const int j = transmission.joint;
    if (armature_[j] <= 0) {
      throw InputError(robot_.robot.name,
                       "joint " + robot_.robot.links[j].joint.name, "",
                       "a transmission that yields needs the motor's own "
                       "inertia: give the joint an armature above 0");
    }
    CHECK_GT(rigid_armature_[j], 0) << "two transmissions on one joint";
    rigid_armature_[j] = 0;
  }
}

void ArmSimulator::ReadInstant(const VectorXd& x, double t) {
  instant_.t = t;
  instant_.link_position = x.head(n_);
  instant_.link_velocity = x.segment(n_, n_);
  instant_.position = instant_.link_position;
  instant_.velocity = instant_.link_velocity;
  for (size_t k = 0; k < robot_.transmissions.size(); ++k) {
    const int j = robot_.transmissions[k].joint;
    instant_.position[j] = x[layout_.motors + 2 * k];
    instant_.velocity[j] = x[layout_.motors + 2 * k + 1];
  }
  instant_.temperature = x.tail(n_);
}

void ArmSimulator::AddActuators(const VectorXd& x) {
  motor_torque_ = commanded_;
  int at = layout_.actuators;
  for (const ActuatorMap& map : robot_.actuators) {
    map.apply(instant_, x.data() + at, rate_.data() + at, &motor_torque_);
    at += map.initial_state.size();
  }
  // Nothing drives them, whatever a map made of their zero.
  motor_torque_.head(robot_.num_passive).setZero();
}

void ArmSimulator::AddJointLaws(const VectorXd& x) {
  heat_.setZero(n_);
  int at = layout_.joint_laws;
  for (const JointLaw& law : robot_.joint_laws) {
    const double torque =
        law.torque(instant_, x.data() + at, rate_.data() + at);
    motor_torque_[law.joint] += torque;
    if (law.heats) heat_[law.joint] -= torque * instant_.velocity[law.joint];
    at += law.initial_state.size();
  }
  for (int j = 0; j < n_; ++j) {
    const JointThermal thermal =
        robot_.thermal.empty() ? JointThermal() : robot_.thermal[j];
    rate_[layout_.temperature + j] =
        (heat_[j] - instant_.temperature[j] / thermal.resistance) /
        thermal.capacity;
  }
}

void ArmSimulator::AddTransmissions(const VectorXd& x) {
  link_torque_ = motor_torque_;
  int at = layout_.transmissions;
  for (size_t k = 0; k < robot_.transmissions.size(); ++k) {
    const Transmission& law = robot_.transmissions[k];
    const int j = law.joint;
    const double torque =
        law.torque(instant_.position[j] - instant_.link_position[j],
                   instant_.velocity[j] - instant_.link_velocity[j],
                   x.data() + at, rate_.data() + at);
    link_torque_[j] = torque;
    const int motor = layout_.motors + 2 * static_cast<int>(k);
    rate_[motor] = instant_.velocity[j];
    rate_[motor + 1] = (motor_torque_[j] - torque) / armature_[j];
    at += law.initial_state.size();
  }
  next_load_ = link_torque_;
}

void ArmSimulator::AddWrenches(const VectorXd& x, double t) {
  int at = layout_.wrenches;
  for (size_t k = 0; k < robot_.wrenches.size(); ++k) {
    const WrenchLaw& law = robot_.wrenches[k];
    const ArmTerms::Point& point = now_.points[k];
    const Eigen::Matrix<double, 6, 1> twist =
        point.jacobian * instant_.link_velocity;
    const Wrench wrench =
        law.wrench({t, point.X_WP, twist.head<3>(), twist.tail<3>()},
                   x.data() + at, rate_.data() + at);
    link_torque_.noalias() +=
        point.jacobian.topRows<3>().transpose() * wrench.moment +
        point.jacobian.bottomRows<3>().transpose() * wrench.force;
    at += law.num_states;
  }
}

void ArmSimulator::Derivative(const VectorXd& x, double t, double share) {
  rate_.setZero(layout_.size);
  ReadInstant(x, t);
  InterpolateTerms(begin_, middle_, end_, share, &now_);
  now_.mass_matrix.diagonal() += rigid_armature_;
  AddActuators(x);
  AddJointLaws(x);
  AddTransmissions(x);
  AddWrenches(x, t);
  cholesky_.Compute(now_.mass_matrix);
  qdd_ = cholesky_.Solve(link_torque_ - now_.bias);
  next_load_ -= rigid_armature_.cwiseProduct(qdd_);
  rate_.head(n_) = instant_.link_velocity;
  rate_.segment(n_, n_) = qdd_;
}

// What laws of rigid joints take of their joint's own velocity at the instant,
// N m s/rad or N s/m; 0 where that would drive it.
VectorXd ArmSimulator::JointDamping() const {
  constexpr double kStep = 1e-7;  // rad/s or m/s
  VectorXd damping = VectorXd::Zero(n_), rate = rate_;
  ArmInstant at = instant_;
  int state = layout_.joint_laws;
  for (const JointLaw& law : robot_.joint_laws) {
    const int j = law.joint;
    const double v = instant_.velocity[j];
    double torque[2];
    for (const int side : {0, 1}) {
      at.velocity[j] = v + (side == 0 ? -kStep : kStep);
      torque[side] = law.torque(at, x_.data() + state, rate.data() + state);
    }
    at.velocity[j] = v;
    damping[j] += (torque[0] - torque[1]) / (2 * kStep);
    state += law.initial_state.size();
  }
  for (const Transmission& law : robot_.transmissions) damping[law.joint] = 0;
  return damping.cwiseMax(0.);
}

// From the rates of a stage to those of the W-method (implicit_stages.h).
void ArmSimulator::MakeImplicit(int stage, double h) {
  if (stage == 0) {
    damping_ = JointDamping();
    MatrixXd inertia = now_.mass_matrix;
    inertia.diagonal() += WMethod::kGamma * h * damping_;
    implicit_cholesky_.Compute(inertia);
  }
  VectorXd sum = WMethod::kGamma * k_[stage].segment(n_, n_);
  for (int j = 0; j < stage; ++j) {
    sum += WMethod::kImplicit[stage][j] * k_[j].segment(n_, n_);
  }
  k_[stage].segment(n_, n_) -=
      implicit_cholesky_.Solve(h * damping_.cwiseProduct(sum));
}

void ArmSimulator::Substep(double t, double share, double h) {
  VectorXd load;
  for (int i = 0; i < WMethod::kStages; ++i) {
    const double node = WMethod::kNode[i];
    // A step begins with its rates there already.
    if (i > 0 || share > 0) {
      x_stage_ = i == 0 ? x_ : x_ + node * h * k_[i - 1];
      Derivative(x_stage_, t + node * h, share + node * h / step_);
    }
    if (i == 0) load = next_load_;
    k_[i] = rate_;
    if (implicit_) MakeImplicit(i, h);
  }
  x_ += h / 6 * (k_[0] + 2 * (k_[1] + k_[2]) + k_[3]);
  // Held over a substep, so that its four stages are of one law.
  instant_.load = load;
}

// The engine's terms `ahead` of the step's begin, where constant jerk leads.
void ArmSimulator::Predict(double ahead, const VectorXd& qdd, ArmTerms* terms) {
  const double h = ahead;
  const auto q = x_.head(n_), qd = x_.segment(n_, n_);
  dynamics_->Evaluate(q + h * (qd + h / 2 * (qdd + h / 3 * jerk_)),
                      qd + h * (qdd + h / 2 * jerk_), attachments_, terms);
}

void ArmSimulator::Step(const VectorXd& commanded) {
  const int passive = robot_.num_passive;
  CHECK_EQ(commanded.size(), n_ - passive);
  commanded_.tail(n_ - passive) = commanded;
  const double t = begin_time_ + step_index_ * step_;
  std::swap(begin_, end_);
  Derivative(x_, t, 0);
  const VectorXd qdd = qdd_;
  Predict(step_ / 2, qdd, &middle_);
  Predict(step_, qdd, &end_);
  for (int k = 0; k < substeps_; ++k) {
    Substep(t + k * step_ / substeps_, k / static_cast<double>(substeps_),
            step_ / substeps_);
  }
  // Of within the step: commands jump between steps.
  jerk_ = (qdd_ - qdd) / step_;
  ++step_index_;
  ReadInstant(x_, begin_time_ + step_index_ * step_);
}

int ArmSimulator::JointOf(Eigen::Index state) const {
  const int k = static_cast<int>(state);
  if (k < layout_.motors) return k % n_;
  const size_t motor = (k - layout_.motors) / 2;
  return motor < robot_.transmissions.size() ? robot_.transmissions[motor].joint
                                             : -1;
}

// d rate / d state at the start, by differences.
MatrixXd ArmSimulator::RatesAtRest() {
  begin_ = middle_ = end_;
  const double dx = 1e-7;
  Derivative(x_, begin_time_, 0);
  const VectorXd rate = rate_;
  MatrixXd A(layout_.size, layout_.size);
  for (int k = 0; k < layout_.size; ++k) {
    VectorXd x = x_;
    x[k] += dx;
    Derivative(x, begin_time_, 0);
    A.col(k) = (rate_ - rate) / dx;
  }
  ReadInstant(x_, begin_time_);
  return A;
}

// At the start: of dampers and springs between motors, links and ground,
// linearised at rest, but for the dampers that steps are implicit in.
ArmSimulator::Mode ArmSimulator::FastestMode() {
  MatrixXd A = RatesAtRest();
  if (implicit_) {
    MatrixXd inertia = end_.mass_matrix;
    inertia.diagonal() += rigid_armature_;
    A.block(n_, n_, n_, n_) +=
        inertia.llt().solve(MatrixXd(JointDamping().asDiagonal()));
  }
  const Eigen::EigenSolver<MatrixXd> modes(A);
  if (modes.info() != Eigen::Success) return {HUGE_VAL, -1};
  Eigen::Index fastest, state;
  const double fastest_rate = modes.eigenvalues().cwiseAbs().maxCoeff(&fastest);
  modes.eigenvectors().col(fastest).cwiseAbs().maxCoeff(&state);
  return {fastest_rate, JointOf(state)};
}

// Of those that laws declare but the start does not show: motor and link on the
// stiffest spring between them.
ArmSimulator::Mode ArmSimulator::FastestDeclaredMode() {
  MatrixXd inertia = end_.mass_matrix;
  inertia.diagonal() += rigid_armature_;
  const MatrixXd mobility = inertia.inverse();
  Mode fastest{0, -1};
  for (const Transmission& law : robot_.transmissions) {
    const int j = law.joint;
    const double rate =
        std::sqrt(law.stiffest * (1 / armature_[j] + mobility(j, j)));
    if (rate > fastest.rate) fastest = {rate, j};
  }
  return fastest;
}

int ArmSimulator::NeededSubsteps() {
  // Fourth-order Runge-Kutta is stable to 2.78 along the real axis. The arm's
  // inertia elsewhere may be smaller than at the start.
  constexpr double kMostPerStep = 1.2;
  const Mode declared = FastestDeclaredMode();
  Mode fastest;
  double wanted = HUGE_VAL;
  for (const bool implicit : {false, true}) {
    implicit_ = implicit;
    const Mode shown = FastestMode();
    fastest = declared.rate > shown.rate ? declared : shown;
    wanted = std::ceil(step_ * fastest.rate / kMostPerStep);
    if (wanted <= kMostSubsteps) break;
  }
  if (!(wanted <= kMostSubsteps)) {
    const std::string joint =
        fastest.joint < 0
            ? ""
            : "joint " + robot_.robot.links[fastest.joint].joint.name;
    throw InputError(robot_.robot.name, joint, "",
                     "its laws are too stiff to simulate: expected time "
                     "constants above 0.02 steps; give joints more armature "
                     "or friction a wider transition through zero velocity");
  }
  return std::max(implicit_ ? kImplicitSubsteps : kFewestSubsteps,
                  static_cast<int>(wanted));
}

}  // namespace armcal
