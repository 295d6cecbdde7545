#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// The zero of the wire's encoder moves little by little.
PoseEffect LengthDrift() {
  PoseEffect effect;
  effect.name = "length_drift";
  effect.means = "the wire reads another length over the order of poses";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    if (!campaign.wire) return std::vector<PosePlace>{};
    return DriftPlaces(campaign, {1}, {1, 2, 4, 8, 16});
  };

  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return MovedBody(PoseTerm::Acts::kLength, place.parts,
                     DriftSignals(campaign.size(), place));
  };
  return effect;
}

}  // namespace armcal
