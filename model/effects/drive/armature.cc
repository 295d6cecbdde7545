#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = armature qdd: the motor's own inertia, referred to the joint.
Effect Armature() {
  Effect effect;
  effect.name = "armature";
  effect.nature = Effect::Nature::kParameter;
  effect.of_construction = true;
  effect.law = "tau = armature qdd";
  effect.shows = "large accelerations of the joint";
  effect.parameters = {
      Linear("armature", "E s^2/P", [](const EffectSite& site) {
        return .05 * TorqueScale(site) / AccelerationScale(site);
      })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    robot->robot.links[site.joint].joint.armature += p[0];
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"armature", IsRotational(site.at().type) ? "kg m^2" : "kg", p[0]}};
  };
  effect.joint_term = JointTerm::kArmature;
  effect.experiment = "fast motion of small amplitude";
  return effect;
}

}  // namespace effects
}  // namespace armcal
