#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// In the link's frame.
std::vector<EffectEstimate> AddedMassEstimates(const EffectSite&,
                                               const Eigen::VectorXd& p) {
  return {{"mass", "kg", p[0]},
          {"hx", "kg m", p[1]},
          {"hy", "kg m", p[2]},
          {"hz", "kg m", p[3]},
          {"inertia", "kg m^2", p[4]}};
}

bool IsOnTheArm(const EffectSite& site,
                const std::vector<EffectEstimate>& estimates) {
  return IsOfAnArm(*site.robot, estimates[0].value);
}

}  // namespace

// A body fixed to a link (a weight, a hose, a valve block), or one that was
// taken off, which has a negative mass: its mass, its first moments hx hy hz
// about the origin of the link's frame, in the link's axes, and the inertia
// about its own centre, taken as the same about all axes. Joints show as much
// of these as they turn: below a vertical axis, its inertia about that alone.
Effect AddedMass() {
  Effect effect;
  effect.name = "added_mass";
  effect.nature = Effect::Nature::kDay;
  effect.law = "tau = ID(link + body) - ID(link)";
  effect.shows = "gravity on this joint and those before, in many poses";
  constexpr double kLever = .1;  // m, as of a payload
  const auto mass = [](const EffectSite& site) {
    return .03 * MovingMass(*site.robot);
  };
  const auto moment = [mass](const EffectSite& site) {
    return kLever * mass(site);
  };
  const auto inertia = [mass](const EffectSite& site) {
    return kLever * kLever * mass(site);
  };
  effect.parameters = {
      Linear("mass", "kg", mass), Linear("hx", "kg m", moment),
      Linear("hy", "kg m", moment), Linear("hz", "kg m", moment),
      Linear("inertia", "kg m^2", inertia, EffectParameter::Sign::kAsFirst)};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    InertialParameters body;
    body.mass = p[0];
    body.first_moment = p.segment<3>(1);
    body.inertia = PointInertia(body.mass, body.first_moment) +
                   p[4] * Eigen::Matrix3d::Identity();
    robot->robot.links[site.joint].inertial += body;
  };
  effect.estimates = AddedMassEstimates;
  effect.unfit = [](const EffectSite& site) -> std::string {
    const bool last = site.joint + 1 == site.robot->num_joints();
    return last && CarriesPayload(*site.robot)
               ? "on the last link it is a payload"
               : WhyNotCarried(site);
  };
  effect.plausible = IsOnTheArm;
  effect.experiment = "poses of the joints before, held, and swung";
  return effect;
}

}  // namespace effects
}  // namespace armcal
