#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// The arm's lengths grow while it is measured, as it warms.
PoseEffect ThermalGrowth() {
  PoseEffect effect;
  effect.name = "growth";
  effect.means = "all lengths of the arm grow from the first pose to the last";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    return DriftPlaces(campaign, {1}, {2});
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return std::vector<PoseTerm>{{PoseTerm::Acts::kScale, 0,
                                  DriftSignals(campaign.size(), place).col(0),
                                  "share", "1"}};
  };
  return effect;
}

}  // namespace armcal
