#include "model/plant/hidden/hidden_effect.h"

#include <cmath>

#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/plant/hidden/random_signal.h"

namespace armcal {

using Eigen::VectorXd;

namespace {

constexpr int kStates = 200;

// Mean squares of the rigid arm's torque and means of its inertia.
void AddRigidScales(const Robot& robot, EffectContext* context) {
  const int n = robot.num_joints();
  std::mt19937_64 random(1);  // scales are the robot's, whatever the seed
  const auto draw = [&](double size) {
    VectorXd v(n);
    for (int j = 0; j < n; ++j) {
      v[j] = size * context->speed[j] * DrawUniform(-1, 1, &random);
    }
    return v;
  };
  for (int k = 0; k < kStates; ++k) {
    const VectorXd q = draw(1.5), qd = draw(1.7), qdd = draw(5);
    context->torque += InverseDynamics(robot, q, qd, qdd).cwiseAbs2() / kStates;
    context->inertia += MassMatrix(robot, q).diagonal() / kStates;
  }
}

}  // namespace

EffectContext TypicalContext(const Robot& robot, std::uint64_t seed) {
  const int n = robot.num_joints();
  EffectContext context;
  context.seed = seed;
  context.speed.resize(n);
  for (int j = 0; j < n; ++j) {
    context.speed[j] = IsRotational(robot.links[j].joint.type) ? 1 : .3;
  }
  context.torque = context.inertia = VectorXd::Zero(n);
  AddRigidScales(robot, &context);
  for (int j = 0; j < n; ++j) {
    const Joint& joint = robot.links[j].joint;
    const double friction = joint.coulomb + joint.viscous * context.speed[j];
    context.torque[j] = std::sqrt(context.torque[j] + friction * friction);
    context.inertia[j] += joint.armature;
  }
  return context;
}

double EffectSite::moving_mass() const {
  double mass = 0;
  for (int j = robot->num_passive; j < robot->robot.num_joints(); ++j) {
    mass += robot->robot.links[j].inertial.mass;
  }
  return mass;
}

namespace {

std::mt19937_64 Stream(const std::vector<std::uint64_t>& seeds,
                       const std::string& kind) {
  std::vector<std::uint32_t> words;
  for (const std::uint64_t seed : seeds) {
    words.push_back(static_cast<std::uint32_t>(seed));
    words.push_back(static_cast<std::uint32_t>(seed >> 32));
  }
  words.insert(words.end(), kind.begin(), kind.end());
  std::seed_seq sequence(words.begin(), words.end());
  return std::mt19937_64(sequence);
}

}  // namespace

std::mt19937_64 EffectSite::Random(const std::string& kind) const {
  return Stream({context->seed, static_cast<std::uint64_t>(joint + 1)}, kind);
}

std::mt19937_64 EffectSite::RandomInTime(const std::string& kind) const {
  return Stream(
      {context->seed, static_cast<std::uint64_t>(joint + 1), context->run},
      kind);
}

void EffectSite::AddFriction(const JointTorque& torque,
                             const VectorXd& initial_state) const {
  robot->joint_laws.push_back({index(), initial_state, true, torque});
}

void EffectSite::AddTorque(const JointTorque& torque) const {
  robot->joint_laws.push_back({index(), VectorXd(), false, torque});
}

}  // namespace armcal
