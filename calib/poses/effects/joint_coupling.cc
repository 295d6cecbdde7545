#include "calib/poses/effects/effect.h"

namespace armcal {

// q_i + k q_j: a joint that is counted from another link than its own (an elbow
// from the ground, k = -+1), a gear that another joint turns.
PoseEffect JointCoupling() {
  PoseEffect effect;
  effect.name = "coupling";
  effect.means = "the joint turns by k times another joint's position as well";
  effect.separate_by = "poses that move each of the two joints alone";
  effect.far_amounts = {-1, 1};
  effect.most_amount = .5;
  effect.places = [](const PoseCampaign& campaign) {
    std::vector<PosePlace> places;
    for (int i = 0; i < campaign.joints(); ++i) {
      for (int j = 0; j < campaign.joints(); ++j) {
        if (i == j || !campaign.Moves(j)) continue;
        PosePlace place;
        place.joint = i;
        place.by = j;
        places.push_back(place);
      }
    }
    return places;
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return std::vector<PoseTerm>{
        PostureTerm(campaign, PoseTerm::Acts::kJoint, place.joint,
                    {PostureSignal::Of::kPosition, place.by}, "k", "rad/rad")};
  };
  return effect;
}

}  // namespace armcal
