#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// The base or the instrument moves little by little.
PoseEffect FrameDrift() {
  PoseEffect effect;
  effect.name = "frame_drift";
  effect.means = "base or instrument stands elsewhere over the order of poses";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    if (campaign.wire) return std::vector<PosePlace>{};
    return DriftPlaces(campaign, {3, 6}, {1, 2, 4, 8, 16});
  };

  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return MovedBody(PoseTerm::Acts::kFrame, place.parts,
                     DriftSignals(campaign.size(), place));
  };
  return effect;
}

}  // namespace armcal
