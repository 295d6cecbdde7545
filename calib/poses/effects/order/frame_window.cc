#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// The base or the instrument moves between two unknown poses, and back.
PoseEffect FrameWindow() {
  PoseEffect effect;
  effect.name = "frame_window";
  effect.means = "base or instrument stands elsewhere in a block of poses";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    if (campaign.wire) return std::vector<PosePlace>{};
    return WindowPlaces(campaign, {3, 6});
  };
  effect.count = &WindowCount;
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return MovedBody(PoseTerm::Acts::kFrame, place.parts,
                     WindowSignal(campaign.size(), place));
  };
  return effect;
}

}  // namespace armcal
