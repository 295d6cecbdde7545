#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/order/order_signals.h"

namespace armcal {

// What carries the target slips on the flange from an unknown pose on.
PoseEffect ToolStep() {
  PoseEffect effect;
  effect.name = "tool_step";
  effect.means =
      "the target or tool sits elsewhere on the arm from one pose on";
  effect.in_order = true;
  effect.separate_by = kRepeatEarlyPoses;
  effect.places = [](const PoseCampaign& campaign) {
    return StepPlaces(campaign, ToolParts(campaign));
  };
  effect.count = &StepCount;
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return MovedBody(PoseTerm::Acts::kTool, place.parts,
                     WindowSignal(campaign.size(), place));
  };
  return effect;
}

}  // namespace armcal
