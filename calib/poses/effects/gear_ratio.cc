#include "calib/poses/effects/each_joint.h"
#include "calib/poses/effects/effect.h"

namespace armcal {

// q_i (1 + k): another gear ratio than the controller's. k = -2 mirrors the
// axis; 180 / pi - 1 is a joint in degrees.
PoseEffect GearRatio() {
  PoseEffect effect;
  effect.name = "gear_ratio";
  effect.means = "the joint turns by 1 + k times what was recorded";
  effect.separate_by = "poses over more of the joint's range";
  effect.far_amounts = {-2};
  effect.turned_round_at = -2;
  effect.most_amount = .5;
  effect.places = [](const PoseCampaign& campaign) {
    return EachJoint(campaign, &PoseCampaign::Moves);
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return std::vector<PoseTerm>{
        PostureTerm(campaign, PoseTerm::Acts::kJoint, place.joint,
                    {PostureSignal::Of::kPosition, place.joint}, "k", "1")};
  };
  return effect;
}

}  // namespace armcal
