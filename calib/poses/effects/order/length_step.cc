#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// The zero of the wire's encoder moves from an unknown pose on.
PoseEffect LengthStep() {
  PoseEffect effect;
  effect.name = "length_step";
  effect.means = "the wire reads another length from one pose on";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    if (!campaign.wire) return std::vector<PosePlace>{};
    return StepPlaces(campaign, {1});
  };
  effect.count = &StepCount;
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return MovedBody(PoseTerm::Acts::kLength, place.parts,
                     WindowSignal(campaign.size(), place));
  };
  return effect;
}

}  // namespace armcal
