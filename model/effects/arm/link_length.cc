#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

constexpr double kNoLength = 1e-3;  // m

// From the joint's axis to the next joint in the joint's moved frame M, across
// the axis of a revolute joint, which feels nothing of what lies along it.
Eigen::Vector3d LengthVector(const EffectSite& site) {
  const Link& link = site.robot->links[site.joint];
  const Link& next = site.robot->links[site.robot->next(site.joint)];
  Eigen::Vector3d p = (link.X_ML * next.X_PF).translation();
  if (IsRotational(link.joint.type)) p.z() = 0;
  return p;
}

Eigen::Vector3d LengthDirection(const EffectSite& site) {
  const Eigen::Vector3d p = LengthVector(site);
  return p.norm() > kNoLength ? p.normalized() : Eigen::Vector3d::UnitX();
}

// A length is a distance: it is above zero, and a link of twice the file's is
// of another arm. Where the file has none, nothing bounds it.
bool IsOfThisLink(const EffectSite& site,
                  const std::vector<EffectEstimate>& estimates) {
  const double length = LengthVector(site).norm();
  return length <= kNoLength || std::abs(estimates[0].value) < length;
}

}  // namespace

// All beyond the link sits `length` further out than in the robot file.
Effect LinkLength() {
  Effect effect;
  effect.name = "link_length";
  effect.nature = Effect::Nature::kParameter;
  effect.of_construction = true;
  effect.law = "tau = ID(l + length) - ID(l)";
  effect.shows = "motion of this joint and those beyond, gravity included";
  effect.parameters = {
      Linear("length", "m", [](const EffectSite&) { return .005; })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const Link& link = site.robot->links[site.joint];
    const Eigen::Vector3d p_L =
        link.X_ML.linear().transpose() * (p[0] * LengthDirection(site));
    for (int k = site.joint + 1; k < site.robot->num_joints(); ++k) {
      if (site.robot->parent(k) != site.joint) continue;
      robot->robot.links[k].X_PF.pretranslate(p_L);
    }
  };
  effect.unfit = [](const EffectSite& site) -> std::string {
    return site.robot->next(site.joint) < 0 ? "the link carries no joint"
                                            : WhyNotCarried(site);
  };
  effect.plausible = IsOfThisLink;
  effect.experiment = "poses seen by a tracker";
  return effect;
}

}  // namespace effects
}  // namespace armcal
