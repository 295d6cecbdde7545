#include "calib/poses/effects/effect.h"

namespace armcal {

// What carries the target gives way along the tool's x and y axes in proportion
// to the component of gravity there, and by so much less along z: giving way
// alike along all three is the same displacement in all poses.
PoseEffect ToolSag() {
  PoseEffect effect;
  effect.name = "tool_sag";
  effect.means = "what carries the target bends under its weight";
  effect.separate_by = "the wrist turned at the same place of the tool";
  effect.places = [](const PoseCampaign&) {
    return std::vector<PosePlace>{{}};
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace&) {
    std::vector<PoseTerm> terms;
    for (int axis = 0; axis < 2; ++axis) {
      terms.push_back(PostureTerm(campaign, PoseTerm::Acts::kTool, axis,
                                  {PostureSignal::Of::kToolGravity, axis},
                                  std::string(1, "xyz"[axis]), "m"));
    }
    return terms;
  };
  return effect;
}

}  // namespace armcal
