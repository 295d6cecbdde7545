#pragma once

#include <vector>

#include "calib/poses/effects/effect.h"

namespace armcal {

// The joint turns by a sin nq + b cos nq, q being where it stands.
inline std::vector<PoseTerm> HarmonicTerms(const PoseCampaign& campaign,
                                           int joint, int harmonic) {
  const auto term = [&](PostureSignal::Of of, const char* name) {
    return PostureTerm(campaign, PoseTerm::Acts::kJoint, joint,
                       {of, joint, harmonic}, name, "rad");
  };
  return {term(PostureSignal::Of::kSine, "sine"),
          term(PostureSignal::Of::kCosine, "cosine")};
}

}  // namespace armcal
