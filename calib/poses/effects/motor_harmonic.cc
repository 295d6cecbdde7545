#include <cmath>

#include "calib/poses/effects/each_joint.h"
#include "calib/poses/effects/effect.h"

namespace armcal {

// a sin Nq + b cos Nq with the gear ratio N: what errs once in a turn of the
// motor (an eccentric encoder or pinion), or, with 2 parts, twice (the two
// lobes of a strain wave gear: Tuttle and Seering 1996).
PoseEffect MotorHarmonic() {
  PoseEffect effect;
  effect.name = "motor_harmonic";
  effect.means = "the joint's position errs once or twice in a motor's turn";
  effect.separate_by = "poses at many angles within one turn of the motor";
  effect.is_harmonic = true;
  effect.places = [](const PoseCampaign& campaign) {
    std::vector<PosePlace> places;
    const std::vector<double>& ratios = campaign.arm.gear_ratios;
    for (PosePlace place : EachJoint(campaign, &PoseCampaign::Turns)) {
      // Without a gear it is the joint's own.
      if (ratios.empty() || std::abs(ratios[place.joint]) < 2.5) continue;
      for (place.parts = 1; place.parts <= 2; ++place.parts) {
        places.push_back(place);
      }
    }
    return places;
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return HarmonicTerms(campaign, place.joint,
                         place.parts * campaign.arm.gear_ratios[place.joint]);
  };
  return effect;
}

}  // namespace armcal
