#include "calib/poses/effects/effect.h"

namespace armcal {

// The instrument's metre is another one (a marker's size, a focal length), or
// all of the arm is longer than its file.
PoseEffect InstrumentScale() {
  PoseEffect effect;
  effect.name = "scale";
  effect.means = "all distances are longer by a share of themselves";
  effect.separate_by = "a length that is known, measured by the instrument";
  effect.places = [](const PoseCampaign&) {
    return std::vector<PosePlace>{{}};
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace&) {
    return std::vector<PoseTerm>{PostureTerm(campaign, PoseTerm::Acts::kScale,
                                             0, {PostureSignal::Of::kOne},
                                             "share", "1")};
  };
  return effect;
}

}  // namespace armcal
