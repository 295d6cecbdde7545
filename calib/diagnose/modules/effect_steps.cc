#include "calib/diagnose/modules/effect_steps.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/dynamics/flanked_spring.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Of differences for slopes.
constexpr double kVelocityStep = 1e-4;    // rad/s or m/s
constexpr double kDeflectionStep = 1e-6;  // rad or m
// Of a motor on its spring: so short that a flank's corner is not passed
// unnoticed, up to springs that turn by five radians a step.
constexpr double kPhasePerSubstep = .05;  // rad
constexpr int kMostMotorSubsteps = 100;

}  // namespace

EffectSteps::EffectSteps(const CorrectedRobot& robot, const VectorXd& load)
    : robot_(robot),
      n_(robot.plant.robot.num_joints()),
      springs_(n_, nullptr),
      load_known_(load.size() > 0) {
  for (const Transmission& law : robot.plant.transmissions) {
    springs_[law.joint] = &law;
  }
  for (int k = 0; k < robot.num_effect_laws; ++k) {
    const JointLaw& law = robot.plant.joint_laws[k];
    CHECK_LE(law.initial_state.size(), 1);
    laws_.push_back({&law, law.initial_state, law.initial_state});
  }
  for (const std::vector<CoulombPart>& parts : robot.coulomb) {
    yielding_.push_back(VectorXd::Zero(parts.size()));
  }
  const VectorXd zero = VectorXd::Zero(n_);
  at_.position = at_.velocity = at_.link_position = at_.link_velocity = zero;
  at_.load = load_known_ ? load : zero;
  at_.temperature = drive_ = heat_ = damping_ = undamped_ = change_ = zero;
  missing_ = spring_ = zero;
}

VectorXd EffectSteps::Sense(double dt, const VectorXd& q, const VectorXd& qd) {
  if (started_) {
    Advance(dt, q, qd);
  } else {
    Start(q, qd);
  }
  Reading reading{at_.position, at_.velocity, VectorXd::Zero(n_),
                  at_.temperature};
  for (const SensorMap& map : robot_.plant.sensors) map.apply(at_, &reading);
  return reading.position;
}

void EffectSteps::Start(const VectorXd& q, const VectorXd& qd) {
  started_ = true;
  at_.position = at_.link_position = q;
  at_.velocity = at_.link_velocity = qd;
  for (int j = 0; j < n_; ++j) {
    if (springs_[j] == nullptr) continue;
    at_.position[j] += springs_[j]->initial_deflection(at_.load[j]);
  }
}

void EffectSteps::Advance(double dt, const VectorXd& q, const VectorXd& qd) {
  AdvanceSlowStates(dt, qd);
  const VectorXd before = at_.link_position;
  change_ = qd - at_.link_velocity;
  at_.link_position = q;
  at_.link_velocity = qd;
  for (int j = 0; j < n_; ++j) {
    if (springs_[j] != nullptr) continue;
    Follow(j, q[j] - before[j], dt);
    at_.position[j] = q[j];
    at_.velocity[j] = qd[j];
  }
  for (int j = 0; j < n_; ++j) {
    if (springs_[j] != nullptr) AdvanceMotor(j, dt, before[j]);
  }
  at_.t += dt;
}

// Lags of commands, warmth and loads until now.
void EffectSteps::AdvanceSlowStates(double dt, const VectorXd& qd) {
  if (!acted_) return;
  if (robot_.delay < 0) {
    lag_ -= std::expm1(dt / robot_.delay) * (commanded_ - lag_);
  }
  for (int j = 0; j < n_; ++j) {
    at_.load[j] = drive_[j] - Armature(j) * (qd[j] - at_.link_velocity[j]) / dt;
    if (robot_.plant.thermal.empty()) continue;
    const JointThermal& thermal = robot_.plant.thermal[j];
    const double kept = std::exp(-dt / (thermal.resistance * thermal.capacity));
    at_.temperature[j] =
        kept * at_.temperature[j] + thermal.resistance * heat_[j] * (1 - kept);
  }
}

// States of the laws of joint j follow as it moves evenly within h. Those of
// effects' laws, z' = a + b z, exactly.
void EffectSteps::Follow(int j, double move, double h) {
  const std::vector<CoulombPart>& parts = robot_.coulomb[j];
  for (size_t k = 0; k < parts.size(); ++k) {
    const CoulombTransition& transition = parts[k].transition;
    if (transition.law != CoulombTransition::Law::kDisplacement) continue;
    double& c = yielding_[j][static_cast<Eigen::Index>(k)];
    c = std::clamp(c + move / transition.width, -1., 1.);
  }
  const double velocity = at_.velocity[j];
  at_.velocity[j] = move / h;
  for (Bristles& bristles : laws_) {
    if (bristles.law->joint != j || bristles.state.size() == 0) continue;
    const double none = 0, one = 1;
    double a, rate;
    bristles.law->torque(at_, &none, &a);
    bristles.law->torque(at_, &one, &rate);
    const double b = rate - a, z = bristles.state[0];
    bristles.state[0] += (b == 0 ? h : std::expm1(b * h) / b) * (a + b * z);
  }
  at_.velocity[j] = velocity;
}

double EffectSteps::OwnFriction(int j) const {
  const Joint& joint = robot_.plant.robot.links[j].joint;
  double torque = joint.viscous * at_.velocity[j];
  const std::vector<CoulombPart>& parts = robot_.coulomb[j];
  for (size_t k = 0; k < parts.size(); ++k) {
    const double state = yielding_[j][static_cast<Eigen::Index>(k)];
    torque += parts[k].force * parts[k].transition.C(at_.velocity[j], state);
  }
  return -torque;
}

double EffectSteps::OnMotor(int j) {
  double torque = OwnFriction(j) - robot_.plant.robot.links[j].joint.offset;
  for (Bristles& bristles : laws_) {
    if (bristles.law->joint != j) continue;
    torque +=
        bristles.law->torque(at_, bristles.state.data(), bristles.rate.data());
  }
  return torque;
}

// The power of friction on joint j, W.
double EffectSteps::Heating(int j) {
  double torque = OwnFriction(j);
  for (Bristles& bristles : laws_) {
    if (bristles.law->joint != j || !bristles.law->heats) continue;
    torque +=
        bristles.law->torque(at_, bristles.state.data(), bristles.rate.data());
  }
  return -torque * at_.velocity[j];
}

double EffectSteps::FrictionSlope(int j) {
  const double v = at_.velocity[j];
  at_.velocity[j] = v + kVelocityStep;
  const double ahead = OnMotor(j);
  at_.velocity[j] = v - kVelocityStep;
  const double behind = OnMotor(j);
  at_.velocity[j] = v;
  return (ahead - behind) / (2 * kVelocityStep);
}

double EffectSteps::SpringTorque(int j, double more, double faster) const {
  return springs_[j]->torque(at_.position[j] - at_.link_position[j] + more,
                             at_.velocity[j] - at_.link_velocity[j] + faster,
                             nullptr, nullptr);
}

double EffectSteps::SlopeOverRate(int j) const {
  return (SpringTorque(j, 0, kVelocityStep) -
          SpringTorque(j, 0, -kVelocityStep)) /
         (2 * kVelocityStep);
}

double EffectSteps::SlopeOverDeflection(int j) const {
  return (SpringTorque(j, kDeflectionStep, 0) -
          SpringTorque(j, -kDeflectionStep, 0)) /
         (2 * kDeflectionStep);
}

double EffectSteps::Armature(int j) const {
  return springs_[j] != nullptr ? 0
                                : robot_.plant.robot.links[j].joint.armature;
}

// The motor of joint j while its link moves evenly.
void EffectSteps::AdvanceMotor(int j, double dt, double link_before) {
  if (!acted_) return;
  const auto* spring = springs_[j]->torque.target<FlankedSpring>();
  CHECK(spring != nullptr);
  const double end = at_.link_position[j], end_velocity = at_.link_velocity[j];
  const double inertia = robot_.plant.robot.links[j].joint.armature;
  const double phase = dt * std::sqrt(spring->stiffness / inertia);
  const int count = static_cast<int>(std::clamp(
      std::ceil(phase / kPhasePerSubstep), 1., 0. + kMostMotorSubsteps));
  at_.link_velocity[j] = (end - link_before) / dt;
  missing_[j] = 0;
  for (int k = 0; k < count; ++k) {
    at_.link_position[j] = link_before + (end - link_before) * (k + .5) / count;
    MotorStep(j, dt / count);
  }
  missing_[j] /= count;
  at_.link_position[j] = end;
  at_.link_velocity[j] = end_velocity;
  // The mean that the motor felt, beside the ends' that the link is given.
  missing_[j] -= (spring_[j] + SpringTorque(j, 0, 0)) / 2;
}

// By the implicit midpoint rule of the laws linearised where the motor is: with
// q' = v, v' = f(q, v) and slopes f_q and f_v its acceleration is
//   (f + h/2 f_q v) / (1 - h/2 f_v - h^2/4 f_q),
// stable however stiff the flanks of a gap are.
void EffectSteps::MotorStep(int j, double h) {
  const double inertia = robot_.plant.robot.links[j].joint.armature;
  const double force = given_[j] + OnMotor(j) - SpringTorque(j, 0, 0);
  const double by_q = -SlopeOverDeflection(j);
  const double friction_by_v = FrictionSlope(j);
  const double by_v = friction_by_v - SlopeOverRate(j);
  const double v = at_.velocity[j];
  const double acceleration =
      (force + h / 2 * by_q * v) / (inertia - h / 2 * by_v - h * h / 4 * by_q);
  const double move = h * (v + h / 2 * acceleration);
  // The spring's mean: what the motor's momentum lacks.
  missing_[j] +=
      given_[j] + OnMotor(j) + (h / 2 * friction_by_v - inertia) * acceleration;
  Follow(j, move, h);
  at_.position[j] += move;
  at_.velocity[j] += h * acceleration;
}

VectorXd EffectSteps::Act(const VectorXd& commanded, const VectorXd& load) {
  if (!acted_) {
    lag_ = commanded;
    if (!load_known_) at_.load = commanded;
  }
  acted_ = true;
  if (load.size() > 0) at_.load = load;
  commanded_ = commanded;
  given_ = robot_.delay < 0 ? lag_ : commanded;
  for (const ActuatorMap& map : robot_.plant.actuators) {
    CHECK_EQ(map.initial_state.size(), 0);
    map.apply(at_, nullptr, nullptr, &given_);
  }
  for (int j = 0; j < n_; ++j) {
    heat_[j] = Heating(j);
    const bool rigid = springs_[j] == nullptr;
    drive_[j] = rigid ? given_[j] + OnMotor(j) : SpringTorque(j, 0, 0);
    spring_[j] = drive_[j];
    if (!rigid) drive_[j] += missing_[j];
    damping_[j] = std::max(0., rigid ? -FrictionSlope(j) : SlopeOverRate(j));
    // The damper of a motor that yields is between it and its link: it goes
    // along with the link, about as that went before.
    undamped_[j] = drive_[j] + damping_[j] * (at_.link_velocity[j] +
                                              (rigid ? 0 : change_[j]));
  }
  return drive_;
}

}  // namespace armcal
