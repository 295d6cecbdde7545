#include "calib/poses/effects/each_joint.h"
#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// A joint's zero moves (a slipping coupling, a warming gear) little by little.
PoseEffect JointDrift() {
  PoseEffect effect;
  effect.name = "joint_drift";
  effect.means = "the joint's zero is another one over the order of poses";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    return OnEachMoving(campaign, DriftPlaces(campaign, {-1}, {1, 2}));
  };

  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return std::vector<PoseTerm>{{PoseTerm::Acts::kJoint, place.joint,
                                  DriftSignals(campaign.size(), place).col(0),
                                  "zero", "rad"}};
  };
  return effect;
}

}  // namespace armcal
