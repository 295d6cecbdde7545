#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// logged q = q + offset: a wrong zero of the encoder.
Effect EncoderOffset() {
  Effect effect;
  effect.name = "encoder_offset";
  effect.law = "tau = ID(q - offset) - ID(q)";
  effect.shows = "gravity on this joint and those beyond, in many poses";
  effect.parameters = {Linear("offset", "P", [](const EffectSite& site) {
    return .01 * Radian(site);
  })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double offset = p[0];
    robot->sensors.push_back({[=](const ArmInstant&, Reading* reading) {
      reading->position[j] += offset;
    }});
  };
  // The whole arm turned about gravity, or moved: nothing changes.
  effect.unfit = [](const EffectSite& site) -> std::string {
    if (site.joint > 0) return "";
    const Eigen::Vector3d axis = site.robot->links[0].X_PF.linear().col(2);
    const bool turns = IsRotational(site.at().type);
    const bool felt = turns && axis.cross(site.robot->gravity).norm() >
                                   1e-6 * site.robot->gravity.norm();
    return felt ? "" : "torques do not depend on the first joint's position";
  };
  effect.experiment = "poses around the joint's range, held";
  return effect;
}

}  // namespace effects
}  // namespace armcal
