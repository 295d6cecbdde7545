#include <cmath>

#include "calib/poses/effects/effect.h"

namespace armcal {

// The base tilts about its horizontal axes in proportion to the moment of a
// weight at the tool: a plate, a pedestal or a rail that bends.
PoseEffect BaseSag() {
  PoseEffect effect;
  effect.name = "base_sag";
  effect.means = "the base tilts under the arm's weight";
  effect.separate_by = "a second target on the base, or another payload";
  effect.places = [](const PoseCampaign& campaign) {
    if (campaign.wire) return std::vector<PosePlace>{};
    return std::vector<PosePlace>{{}};
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace&) {
    const Eigen::Vector3d down = campaign.robot().gravity.stableNormalized();
    std::vector<PoseTerm> terms;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(down[axis]) > .9) continue;  // a moment has none about it
      terms.push_back(PostureTerm(campaign, PoseTerm::Acts::kBase, axis,
                                  {PostureSignal::Of::kBaseMoment, axis},
                                  std::string("about ") + "xyz"[axis],
                                  "rad/m"));
    }
    return terms;
  };
  return effect;
}

}  // namespace armcal
