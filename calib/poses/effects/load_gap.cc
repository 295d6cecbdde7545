#include <algorithm>

#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/sag_terms.h"

namespace armcal {
namespace {

// Of the poses, on the side that has fewer.
constexpr double kLeastShareOfASide = .05;

}  // namespace

// Play of a gear: weight lays the joint on one side of it or on the other, half
// of the gap from the middle.
PoseEffect LoadGap() {
  PoseEffect effect;
  effect.name = "load_gap";
  effect.means = "weight lays the joint on one side of its play or the other";
  effect.separate_by =
      "poses close to where the joint's load changes its sign, from both sides";
  effect.places = [](const PoseCampaign& campaign) {
    std::vector<PosePlace> places;
    for (int i = 0; i < campaign.joints(); ++i) {
      const auto moment = campaign.tool_moment.col(i).array();
      const double up = (moment > 0).cast<double>().mean();
      if (!FeelsWeight(campaign, i)) continue;
      if (std::min(up, 1 - up) < kLeastShareOfASide) continue;
      PosePlace place;
      place.joint = i;
      places.push_back(place);
    }
    return places;
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace& place) {
    return std::vector<PoseTerm>{PostureTerm(
        campaign, PoseTerm::Acts::kJoint, place.joint,
        {PostureSignal::Of::kLoadSide, place.joint}, "half the play", "rad")};
  };
  return effect;
}

}  // namespace armcal
