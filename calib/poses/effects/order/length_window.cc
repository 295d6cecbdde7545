#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// The zero of the wire's encoder moves between two unknown poses, and back.
PoseEffect LengthWindow() {
  PoseEffect effect;
  effect.name = "length_window";
  effect.means = "the wire reads another length in a block of poses";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    if (!campaign.wire) return std::vector<PosePlace>{};
    return WindowPlaces(campaign, {1});
  };
  effect.count = &WindowCount;
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return MovedBody(PoseTerm::Acts::kLength, place.parts,
                     WindowSignal(campaign.size(), place));
  };
  return effect;
}

}  // namespace armcal
