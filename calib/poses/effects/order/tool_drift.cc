#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// What carries the target slips on the flange little by little.
PoseEffect ToolDrift() {
  PoseEffect effect;
  effect.name = "tool_drift";
  effect.means =
      "the target or tool sits elsewhere on the arm over the order of poses";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    return DriftPlaces(campaign, ToolParts(campaign), {1, 2, 4, 8, 16});
  };

  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return MovedBody(PoseTerm::Acts::kTool, place.parts,
                     DriftSignals(campaign.size(), place));
  };
  return effect;
}

}  // namespace armcal
