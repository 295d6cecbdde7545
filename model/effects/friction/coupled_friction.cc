#include <algorithm>
#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// The joint further out that a bearing couples with the site's, from 0; none:
// -1. Told from its other side the same bearing has friction times ratio,
// viscous times ratio^2 and 1 / ratio, so that it is looked for from one side
// only.
int CoupledNeighbour(const EffectSite& site) {
  const int k = site.robot->next(site.joint);
  if (k < 0) return -1;
  EffectSite other = site;
  other.joint = k;
  const std::vector<int> out = Neighbours(site), in = Neighbours(other);
  const bool coupled = std::count(out.begin(), out.end(), k) > 0 ||
                       std::count(in.begin(), in.end(), site.joint) > 0;
  return coupled ? k : -1;
}

std::string WhyNotCoupled(const EffectSite& site) {
  if (site.robot->num_joints() == 1) return "the robot has one joint";
  return CoupledNeighbour(site) >= 0
             ? ""
             : "a bearing is looked for on the joint that is nearer the base";
}

std::vector<EffectParameter> CoupledParameters() {
  return {Linear("friction", "E", ShareOfTorque(.05),
                 EffectParameter::Sign::kPositive),
          Linear("viscous", "E s/P", ShareOfDrag(.05),
                 EffectParameter::Sign::kPositive),
          Gridded("neighbour", "1",
                  [](const EffectSite& site) {
                    return std::vector<double>{CoupledNeighbour(site) + 1.};
                  }),
          Gridded("ratio", "1",
                  [](const EffectSite& site) {
                    // Between a turning and a sliding joint in rad/m or m/rad.
                    EffectSite other = site;
                    other.joint = std::max(0, CoupledNeighbour(site));
                    const double r = Radian(site) / Radian(other);
                    return std::vector<double>{-2 * r, -r, -.5 * r,
                                               .5 * r, r,  2 * r};
                  }),
          // Dry, or of a lubricated seal, whose friction grows until half the
          // usual speed; but no wider than Coulomb friction is anywhere.
          Gridded("width", "P/s", [](const EffectSite& site) {
            const double dry = site.scale->width[site.joint];
            const double wide =
                std::min(.5 * SpeedScale(site),
                         CoulombTransition::kWidestVelocity * Radian(site));
            return std::vector<double>{dry, std::max(wide, 2 * dry)};
          })};
}

void ApplyCoupled(const EffectSite& site, const Eigen::VectorXd& p,
                  SimulatedRobot* robot) {
  const int j = site.joint, k = static_cast<int>(std::lround(p[2])) - 1;
  const double friction = p[0], viscous = p[1], ratio = p[3], w = p[4];
  const InstantTorque torque = [=](const ArmInstant& at) {
    const double u = at.velocity[j] + ratio * at.velocity[k];
    return -(friction * std::tanh(u / w) + viscous * u);
  };
  AddFriction(site, torque, robot);
  EffectSite other = site;
  other.joint = k;
  AddFriction(
      other, [=](const ArmInstant& at) { return ratio * torque(at); }, robot);
}

}  // namespace

// tau = -(friction tanh(u / width) + viscous u) on the joint and ratio times
// that on its neighbour, u = v + ratio v_neighbour: a bearing between two
// shafts of a wrist turns with u, and its torque's power is never positive. The
// wrist of a Staubli TX40 has both parts (shared/data/tx40/TRUTH.md).
Effect CoupledFriction() {
  Effect effect;
  effect.name = "coupled_friction";
  effect.nature = Effect::Nature::kLaw;
  effect.law =
      "tau = friction sign(u) + viscous u, u = v + ratio v_neighbour, here and "
      "ratio times there";
  effect.shows = "neighbours that move one without the other and together";
  effect.parameters = CoupledParameters();
  effect.apply = ApplyCoupled;
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{{"friction", UnitAt(site, "E"), p[0]},
                                       {"viscous", UnitAt(site, "E s/P"), p[1]},
                                       {"ratio", "1", p[3]},
                                       {"neighbour", "1", p[2]}};
  };
  effect.unfit = WhyNotCoupled;
  effect.stand_ins = {JointTerm::kViscous, JointTerm::kCoulomb};
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"friction", p[0]},
                         {"viscous", p[1]},
                         {"ratio", p[3]},
                         {"width", p[4]},
                         {"neighbour", p[2]}};
  };
  effect.experiment =
      "this joint and its neighbour alone, then both, with equal and with "
      "opposite velocities";
  return effect;
}

}  // namespace effects
}  // namespace armcal
