#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// A cylinder from a pivot on the link to one on what carries the joint, a and r
// from its axis, x the angle between them. Its length is L = a l(x),
//   l = sqrt(1 + ratio^2 - 2 ratio cos x), ratio = r / a,
// and a force F along it has the lever a r sin(x) / L.
struct Cylinder {
  double nearest, ratio;
  double Length(double q) const {  // of a
    return std::sqrt(1 + ratio * ratio - 2 * ratio * std::cos(q - nearest));
  }
};

// A whole turn in steps, and a step beyond it at either end.
std::vector<double> Angles() {
  constexpr int kSteps = 6;
  std::vector<double> angles;
  for (int k = -1; k <= kSteps; ++k) {
    angles.push_back(2 * M_PI * k / kSteps - M_PI);
  }
  return angles;
}

std::vector<EffectParameter> CylinderParameters() {
  return {Linear("rate", "E", ShareOfTorque(.05)),
          Linear("pull", "E", ShareOfTorque(.05)),
          Refined("nearest", "rad", Angles()),
          Gridded("ratio", "1", [](const EffectSite&) {
            return std::vector<double>{.1, .25, .6, .9};
          })};
}

}  // namespace

// tau = -sin(x) (rate + pull / l): the cylinder of a counterbalance, whose
// force F = F0 + K L, of a spring or of gas over a part of its stroke, pulls
// its pivots together (rate = K a r, pull = F0 r). Over a whole turn it is no
// spring of the joint; the rate alone is what a weight does as well.
Effect Counterbalance() {
  Effect effect;
  effect.name = "counterbalance";
  effect.nature = Effect::Nature::kLaw;
  effect.law =
      "tau = -sin(x) (rate + pull / sqrt(1 + ratio^2 - 2 ratio cos x)), x = q "
      "- nearest";
  effect.shows = "slow motion over the joint's whole range";
  effect.parameters = CylinderParameters();
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double rate = p[0], pull = p[1];
    const Cylinder cylinder{p[2], p[3]};
    AddTorque(
        site,
        [=](const ArmInstant& at) {
          const double q = at.position[j];
          return -std::sin(q - cylinder.nearest) *
                 (rate + pull / cylinder.Length(q));
        },
        robot);
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    const Cylinder cylinder{p[2], p[3]};
    const double across = p[0] + p[1] / cylinder.Length(p[2] + M_PI / 2);
    return std::vector<EffectEstimate>{
        {"torque", UnitAt(site, "E"), across},
        {"nearest", "rad", std::remainder(p[2], 2 * M_PI)},
        {"ratio", "1", p[3]},
        {"rate", UnitAt(site, "E"), p[0]},
        {"pull", UnitAt(site, "E"), p[1]}};
  };
  effect.unfit = [](const EffectSite& site) -> std::string {
    return IsRotational(site.robot->links[site.joint].joint.type)
               ? ""
               : "only a joint that turns has such a cylinder";
  };
  effect.means = {"spring", "torque_offset"};
  effect.experiment = "slow sweeps over the whole range, both ways";
  return effect;
}

}  // namespace effects
}  // namespace armcal
