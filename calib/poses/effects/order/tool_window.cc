#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// What carries the target slips on the flange between two unknown poses, and
// back.
PoseEffect ToolWindow() {
  PoseEffect effect;
  effect.name = "tool_window";
  effect.means =
      "the target or tool sits elsewhere on the arm in a block of poses";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    return WindowPlaces(campaign, ToolParts(campaign));
  };
  effect.count = &WindowCount;
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return MovedBody(PoseTerm::Acts::kTool, place.parts,
                     WindowSignal(campaign.size(), place));
  };
  return effect;
}

}  // namespace armcal
