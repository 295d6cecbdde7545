#include "calib/poses/effects/each_joint.h"
#include "calib/poses/effects/effect.h"

namespace armcal {

// a sin q + b cos q: an encoder or a wheel whose centre lies off the axis by e
// of its radius r errs by e/r once in a turn.
PoseEffect EccentricEncoder() {
  PoseEffect effect;
  effect.name = "eccentricity";
  effect.means = "the joint's position errs once in a turn";
  effect.separate_by = "poses over more of the joint's range";
  effect.is_harmonic = true;
  effect.places = [](const PoseCampaign& campaign) {
    return EachJoint(campaign, &PoseCampaign::Turns);
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return HarmonicTerms(campaign, place.joint, 1);
  };
  return effect;
}

}  // namespace armcal
