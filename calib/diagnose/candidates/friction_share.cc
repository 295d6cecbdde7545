#include "calib/diagnose/candidates/friction_share.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kSpeeds = 12;     // in each direction
constexpr double kFastest = 2;  // of the rms
constexpr int kSteps = 2000;
constexpr double kTravel = .1;  // rad or m, after which friction is steady

// A friction law with states is stepped at a steady velocity until kTravel of
// way, as far as its states go; what it then gives is what a law of velocity
// alone would have.
double SteadyTorque(const JointLaw& law, const MotionScale& scale, double v) {
  const Eigen::Index n = scale.low.size();
  ArmInstant at;
  at.position = (scale.low + scale.high) / 2;
  at.velocity = at.load = at.temperature = VectorXd::Zero(n);
  at.velocity[law.joint] = v;
  at.link_velocity = at.velocity;
  VectorXd state = law.initial_state, rate = state;
  const double step = kTravel / std::abs(v) / kSteps;
  double torque = 0;
  const int steps = state.size() == 0 ? 1 : kSteps;
  for (int k = 0; k < steps; ++k) {
    at.link_position = at.position;
    torque = law.torque(at, state.data(), rate.data());
    state += step * rate;
    at.position[law.joint] += step * v;
  }
  return -torque;
}

}  // namespace

// The viscous and Coulomb friction that fits a law best over the joint's usual
// speeds, by least squares of kSpeeds of them in each direction: what a robot
// file without other laws can hold of it.
FrictionShare ShareOfFriction(const CarriedEffect& effect, const Robot& robot,
                              const MotionScale& scale) {
  const int j = effect.found.joint;
  if (j < 0 || !effect.found.effect->velocity_friction) return {};
  SimulatedRobot plant;
  plant.robot = robot;
  effect.found.effect->apply({&robot, j, &scale}, effect.found.p, &plant);
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (int k = -kSpeeds; k <= kSpeeds; ++k) {
    if (k == 0) continue;
    const double v = kFastest * scale.speed[j] * k / kSpeeds;
    double torque = 0;
    for (const JointLaw& law : plant.joint_laws) {
      if (law.joint == j) torque += SteadyTorque(law, scale, v);
    }
    const Eigen::Vector2d columns(v, k > 0 ? 1 : -1);
    normal += columns * columns.transpose();
    right += columns * torque;
  }
  const Eigen::Vector2d x = normal.ldlt().solve(right);
  if (!x.allFinite()) return {};
  return {x[0], x[1]};
}

}  // namespace armcal
