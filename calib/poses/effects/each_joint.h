#pragma once

#include <vector>

#include "calib/poses/effects/effect.h"

namespace armcal {

// A place for each joint that `fits`.
inline std::vector<PosePlace> EachJoint(const PoseCampaign& campaign,
                                        bool (PoseCampaign::*fits)(int) const) {
  std::vector<PosePlace> places;
  for (int i = 0; i < campaign.joints(); ++i) {
    if (!(campaign.*fits)(i)) continue;
    PosePlace place;
    place.joint = i;
    places.push_back(place);
  }
  return places;
}

}  // namespace armcal
