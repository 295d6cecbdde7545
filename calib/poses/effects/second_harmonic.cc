#include "calib/poses/effects/each_joint.h"
#include "calib/poses/effects/effect.h"

namespace armcal {

// a sin 2q + b cos 2q: two reading heads of an eccentric encoder cancel its
// first harmonic and leave the second, as an oval wheel has it.
PoseEffect SecondHarmonic() {
  PoseEffect effect;
  effect.name = "second_harmonic";
  effect.means = "the joint's position errs twice in a turn";
  effect.separate_by = "poses over more of the joint's range";
  effect.is_harmonic = true;
  effect.places = [](const PoseCampaign& campaign) {
    return EachJoint(campaign, &PoseCampaign::Turns);
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return HarmonicTerms(campaign, place.joint, 2);
  };
  return effect;
}

}  // namespace armcal
