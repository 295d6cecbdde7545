#include "model/dynamics/inverse_dynamics.h"
#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// Whether any torque depends on the position of the joint, in a few states
// without symmetry.
bool IsFelt(const Robot& robot, int joint) {
  constexpr int kStates = 3;
  const int n = robot.num_joints();
  for (int state = 0; state < kStates; ++state) {
    const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(n, 1, n) + 10 * state;
    Eigen::VectorXd q = (1.7 * x).sin();
    const Eigen::VectorXd qd = (2.9 * x).sin(), qdd = (4.3 * x).sin();
    const Eigen::VectorXd tau = InverseDynamics(robot, q, qd, qdd);
    q[joint] += .1;
    const Eigen::VectorXd other = InverseDynamics(robot, q, qd, qdd);
    if ((other - tau).norm() > 1e-9 * tau.norm()) return true;
  }
  return false;
}

}  // namespace

// logged q = q + offset: a wrong zero of the encoder.
Effect EncoderOffset() {
  Effect effect;
  effect.name = "encoder_offset";
  effect.nature = Effect::Nature::kRecording;
  effect.law = "tau = ID(q - offset) - ID(q)";
  effect.shows = "gravity on this joint and those beyond, in many poses";
  effect.parameters = {Linear("offset", "P", [](const EffectSite& site) {
    return .01 * Radian(site);
  })};
  // Torque goes by sines of the angle, whose second derivative makes a tangent
  // at 0 wrong by half of the angle, 15 % at .3 rad.
  effect.larger_sizes = {-30, -10, 10, 30};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double offset = p[0];
    robot->sensors.push_back({[=](const ArmInstant&, Reading* reading) {
      reading->position[j] += offset;
    }});
  };
  effect.unfit = [](const EffectSite& site) -> std::string {
    return IsFelt(*site.robot, site.joint)
               ? ""
               : "torques do not depend on the joint's position";
  };
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"offset", p[0]}};
  };
  effect.experiment = "poses around the joint's range, held";
  return effect;
}

}  // namespace effects
}  // namespace armcal
