#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// A pendulum shows no weight on its axis; what tells mass from lever there is
// the inertia about it.
bool IsOnTheOnlyAxis(const Robot& robot) {
  constexpr double kOnAxis = 1e-9;  // m
  if (robot.num_joints() != 1) return false;
  const Link& link = robot.links[0];
  const Eigen::Vector3d p_MT = link.X_ML * robot.X_LT.translation();
  return IsRotational(link.joint.type) && p_MT.head<2>().norm() < kOnAxis;
}

// A point mass has the inertia |h|^2 / mass about an axis that its first
// moments h are about.
double Mass(const Robot& robot, const Eigen::VectorXd& p) {
  if (!IsOnTheOnlyAxis(robot)) return p[0];
  const Eigen::Vector3d h_M = robot.links[0].X_ML.linear() * p.segment<3>(1);
  return p[0] != 0 ? h_M.head<2>().squaredNorm() / p[0] : 0;
}

// In the last link's frame.
std::vector<EffectEstimate> PayloadEstimates(const EffectSite& site,
                                             const Eigen::VectorXd& p) {
  const double mass = Mass(*site.robot, p);
  const Eigen::Vector3d com =
      site.robot->X_LT.translation() + p.segment<3>(1) / mass;
  return {{"mass", "kg", mass},
          {"com_x", "m", com.x()},
          {"com_y", "m", com.y()},
          {"com_z", "m", com.z()},
          {"inertia", "kg m^2", p[4]}};
}

// A centre of mass far from the last link is of no load, nor is a moment
// without a mass, whose centre is infinitely far; of nothing (0 / 0) it is
// anywhere.
bool IsCarried(const EffectSite& site,
               const std::vector<EffectEstimate>& estimates) {
  constexpr double kFarthest = 1;  // m, from the last link's frame
  double squared = 0;
  for (const EffectEstimate& estimate : estimates) {
    if (estimate.name.rfind("com_", 0) == 0 && !std::isnan(estimate.value)) {
      squared += estimate.value * estimate.value;
    }
  }
  return squared <= kFarthest * kFarthest &&
         IsOfAnArm(*site.robot, estimates[0].value);
}

}  // namespace

// A body on the tool, or since a reference one that was taken off, which has a
// negative mass (a file's last link that is too heavy is that link's, see
// LinkInertia): its mass, its first moments hx hy hz about the tool frame's
// origin, in the last link's axes, and the inertia about its own centre, taken
// as the same about all axes; but of a pendulum with the tool's frame on its
// axis, where the first parameter is the inertia about that over 1 m^2, in the
// place of the mass, and the last is nothing.
Effect Payload() {
  Effect effect;
  effect.name = "payload";
  effect.scope = Effect::Scope::kRobot;
  effect.nature = Effect::Nature::kDay;
  effect.law = "tau = ID(last link + payload) - ID(last link)";
  effect.shows = "gravity in many poses of the wrist";
  const auto mass = [](const EffectSite& site) {
    return .03 * MovingMass(*site.robot);
  };
  const auto moment = [mass](const EffectSite& site) {
    return .1 * mass(site);  // 0.1 m off
  };
  const auto inertia = [mass](const EffectSite& site) {
    constexpr double kRadius = .05;  // m
    return kRadius * kRadius * mass(site);
  };
  effect.parameters = {
      Linear("mass", "kg", mass, EffectParameter::Sign::kPositive),
      Linear("hx", "kg m", moment), Linear("hy", "kg m", moment),
      Linear("hz", "kg m", moment),
      Linear("inertia", "kg m^2", inertia, EffectParameter::Sign::kAsFirst)};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    InertialParameters payload;
    payload.mass = Mass(*site.robot, p);
    payload.first_moment = p.segment<3>(1);
    payload.inertia =
        IsOnTheOnlyAxis(*site.robot)
            ? Eigen::Matrix3d(p[0] * Eigen::Matrix3d::Identity())
            : Eigen::Matrix3d(PointInertia(payload.mass, payload.first_moment) +
                              p[4] * Eigen::Matrix3d::Identity());
    const Eigen::Isometry3d X_LP(
        Eigen::Translation3d(robot->robot.X_LT.translation()));
    robot->robot.links.back().inertial += payload.ReexpressIn(X_LP);
  };
  effect.estimates = PayloadEstimates;
  effect.unfit = [](const EffectSite& site) -> std::string {
    if (CarriesPayload(*site.robot)) return "";
    return "no joint moves the tool's frame: a mass on the last link tells its "
           "moment alone";
  };
  effect.plausible = IsCarried;
  effect.experiment = "poses of the wrist, held, and the arm swung";
  return effect;
}

}  // namespace effects
}  // namespace armcal
