#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// In the last link's frame.
std::vector<EffectEstimate> PayloadEstimates(const EffectSite& site,
                                             const Eigen::VectorXd& p) {
  const Eigen::Vector3d com =
      site.robot->X_LT.translation() + p.segment<3>(1) / p[0];
  return {{"mass", "kg", p[0]},
          {"com_x", "m", com.x()},
          {"com_y", "m", com.y()},
          {"com_z", "m", com.z()}};
}

}  // namespace

// A body on the tool: its mass, its first moments hx hy hz about the tool
// frame's origin, in the last link's axes. Its inertia about that origin is
// left out, which torques hardly show.
Effect Payload() {
  Effect effect;
  effect.name = "payload";
  effect.scope = Effect::Scope::kRobot;
  effect.law = "tau = ID(last link + payload) - ID(last link)";
  effect.shows = "gravity in many poses of the wrist";
  const auto mass = [](const EffectSite& site) {
    return .03 * MovingMass(*site.robot);
  };
  const auto moment = [mass](const EffectSite& site) {
    return .1 * mass(site);  // 0.1 m off
  };
  effect.parameters = {
      Linear("mass", "kg", mass, EffectParameter::Sign::kPositive),
      Linear("hx", "kg m", moment), Linear("hy", "kg m", moment),
      Linear("hz", "kg m", moment)};
  effect.apply = [](const EffectSite&, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    InertialParameters payload;
    payload.mass = p[0];
    payload.first_moment = p.segment<3>(1);
    const Eigen::Isometry3d X_LP(
        Eigen::Translation3d(robot->robot.X_LT.translation()));
    robot->robot.links.back().inertial += payload.ReexpressIn(X_LP);
  };
  effect.estimates = PayloadEstimates;
  effect.experiment = "poses of the wrist, held, and the arm swung";
  return effect;
}

}  // namespace effects
}  // namespace armcal
