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

// Each of `places` on each joint that moves.
inline std::vector<PosePlace> OnEachMoving(
    const PoseCampaign& campaign, const std::vector<PosePlace>& places) {
  std::vector<PosePlace> all;
  for (const PosePlace& joint : EachJoint(campaign, &PoseCampaign::Moves)) {
    for (PosePlace place : places) {
      place.joint = joint.joint;
      all.push_back(place);
    }
  }
  return all;
}

// The joint turns by a sin nq + b cos nq, q being where it stands.
inline std::vector<PoseTerm> HarmonicTerms(const PoseCampaign& campaign,
                                           int joint, double harmonic) {
  const auto term = [&](PostureSignal::Of of, const char* name) {
    return PostureTerm(campaign, PoseTerm::Acts::kJoint, joint,
                       {of, joint, harmonic}, name, "rad");
  };
  return {term(PostureSignal::Of::kSine, "sine"),
          term(PostureSignal::Of::kCosine, "cosine")};
}

}  // namespace armcal
