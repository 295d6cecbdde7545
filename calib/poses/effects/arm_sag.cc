#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/sag_terms.h"

namespace armcal {

// All joints that feel weight give way, each by a compliance of its own.
PoseEffect ArmSag() {
  PoseEffect effect;
  effect.name = "sag";
  effect.means = "joints give way under weight, each by its own compliance";
  effect.separate_by =
      "the same poses with another payload, or with the arm stretched and "
      "folded at the same positions of the joints before it";
  effect.places = [](const PoseCampaign& campaign) {
    std::vector<PosePlace> places;
    int joints = 0;
    for (int i = 0; i < campaign.joints(); ++i) {
      joints += FeelsWeight(campaign, i);
    }
    if (joints < 2) return places;  // joint_sag
    for (int parts = 1; parts <= (campaign.arm.weighed ? 1 : 2); ++parts) {
      PosePlace place;
      place.parts = parts;
      places.push_back(place);
    }
    return places;
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    std::vector<PoseTerm> terms;
    for (int i = 0; i < campaign.joints(); ++i) {
      if (!FeelsWeight(campaign, i)) continue;
      for (const PoseTerm& term : SagTerms(campaign, i, place.parts)) {
        terms.push_back(term);
      }
    }
    return terms;
  };
  return effect;
}

}  // namespace armcal
