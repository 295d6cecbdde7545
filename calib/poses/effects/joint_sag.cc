#include "calib/poses/effects/each_joint.h"
#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/sag_terms.h"

namespace armcal {

// One joint that turns under the moment of gravity about it.
PoseEffect JointSag() {
  PoseEffect effect;
  effect.name = "joint_sag";
  effect.part_of = "sag";
  effect.means = "the joint gives way under weight";
  effect.separate_by =
      "the same poses with another payload, or with the arm stretched and "
      "folded at the same position of the joint";
  effect.places = [](const PoseCampaign& campaign) {
    std::vector<PosePlace> places;
    for (int i = 0; i < campaign.joints(); ++i) {
      if (!FeelsWeight(campaign, i)) continue;
      for (int parts = 1; parts <= (campaign.arm.weighed ? 1 : 2); ++parts) {
        PosePlace place;
        place.joint = i;
        place.parts = parts;
        places.push_back(place);
      }
    }
    return places;
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return SagTerms(campaign, place.joint, place.parts);
  };
  return effect;
}

}  // namespace armcal
