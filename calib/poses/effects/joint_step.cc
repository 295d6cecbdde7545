#include <utility>

#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order_signals.h"

namespace armcal {

// A joint's zero moves (a slipping coupling, a warming gear) from an unknown
// pose on.
PoseEffect JointStep() {
  PoseEffect effect;
  effect.name = "joint_step";
  effect.means = "the joint's zero is another one from one pose on";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    std::vector<int> joints;
    for (int i = 0; i < campaign.joints(); ++i) {
      if (campaign.Moves(i)) joints.push_back(i);
    }
    std::vector<PosePlace> places = StepPlaces(campaign, joints);
    for (PosePlace& place : places) std::swap(place.joint, place.parts);
    return places;
  };
  effect.count = [](const PoseCampaign& campaign) {
    return StepCount(campaign) * campaign.joints();
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return std::vector<PoseTerm>{{PoseTerm::Acts::kJoint, place.joint,
                                  WindowSignal(campaign.size(), place), "zero",
                                  "rad"}};
  };
  return effect;
}

}  // namespace armcal
