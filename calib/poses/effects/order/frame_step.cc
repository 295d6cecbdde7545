#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// The base or the instrument moves from an unknown pose on.
PoseEffect FrameStep() {
  PoseEffect effect;
  effect.name = "frame_step";
  effect.means = "base or instrument stands elsewhere from one pose on";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    if (campaign.wire) return std::vector<PosePlace>{};
    return StepPlaces(campaign, {3, 6});
  };
  effect.count = &StepCount;
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return MovedBody(PoseTerm::Acts::kFrame, place.parts,
                     WindowSignal(campaign.size(), place));
  };
  return effect;
}

}  // namespace armcal
