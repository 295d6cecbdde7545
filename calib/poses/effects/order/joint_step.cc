#include "calib/poses/effects/each_joint.h"
#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

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
    return OnEachMoving(campaign, StepPlaces(campaign, {-1}));
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
