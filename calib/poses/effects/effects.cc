#include "calib/poses/effects/effect.h"
#include "calib/poses/effects/effect_list.h"

namespace armcal {

#define ARMCAL_DECLARE(function) PoseEffect function();
ARMCAL_POSE_EFFECTS(ARMCAL_DECLARE)
#undef ARMCAL_DECLARE

const std::vector<PoseEffect>& PoseEffects() {
#define ARMCAL_MAKE(function) function(),
  static const std::vector<PoseEffect> effects = {
      ARMCAL_POSE_EFFECTS(ARMCAL_MAKE)};
#undef ARMCAL_MAKE
  return effects;
}

PoseTerm PostureTerm(const PoseCampaign& campaign, PoseTerm::Acts acts,
                     int index, const PostureSignal& goes_with,
                     const std::string& name, const std::string& unit) {
  return {acts, index, SignalAt(campaign, goes_with), name, unit, goes_with};
}

std::string PlacedName(const PoseEffect& effect, const PoseCampaign& campaign,
                       const PosePlace& place) {
  const auto joint = [&](int i) {
    return campaign.robot().links[i].joint.name;
  };
  std::string name = effect.name;
  if (place.joint >= 0) name += " of " + joint(place.joint);
  if (place.by >= 0) name += " with " + joint(place.by);
  if (place.begin < 0) return name;
  if (place.end < 0) {
    return name + " from " + campaign.word + " " +
           std::to_string(campaign.number[place.begin]) + " on";
  }
  return name + " of " + campaign.word + "s " +
         std::to_string(campaign.number[place.begin]) + " to " +
         std::to_string(campaign.number[place.end - 1]);
}

}  // namespace armcal
