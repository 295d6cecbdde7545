#include "calib/diagnose/judge/body_places.h"

#include <gmock/gmock.h>

#include "tests/fixtures/found_effect.h"

namespace armcal::body_places_test {

using testing::ElementsAre;

FoundEffect OneOf(const std::string& name, int joint, double probability,
                  const std::vector<PlacedEffect>& others) {
  FoundEffect found = Found(name, joint, 100);
  found.probability = probability;
  found.any_probability = .95;
  found.equivalent = others;
  return found;
}

std::vector<std::string> OtherPlaces(const FoundEffect& found) {
  std::vector<FoundEffect> places;
  for (const PlacedEffect& other : found.or_at) {
    places.push_back(Found(other.effect->name, other.joint, 0));
  }
  return Names(places);
}

// Places exclude each other, so that their probabilities add; a spring is none.
TEST(PoolPlacesOfBody, ABodyIsAsProbableAsItsPlacesTogether) {
  FoundEffect found = OneOf("added_mass", 4, .45,
                            {{FindEffect("spring"), 1, .1},
                             {FindEffect("payload"), -1, .3},
                             {FindEffect("added_mass"), 3, .1}});
  PoolPlacesOfBody(&found);
  EXPECT_NEAR(found.probability, .85, 1e-12);
  EXPECT_NEAR(found.any_probability, .95, 1e-12);
  EXPECT_THAT(OtherPlaces(found), ElementsAre("payload@0", "added_mass@4"));
  EXPECT_EQ(found.equivalent.size(), 3u) << "which keep their own";
}

TEST(PoolPlacesOfBody, APlaceThatIsToldHasNoOther) {
  FoundEffect found = OneOf(
      "payload", -1, .9,
      {{FindEffect("added_mass"), 4, .02}, {FindEffect("base_tilt"), -1, .03}});
  PoolPlacesOfBody(&found);
  EXPECT_EQ(found.probability, .9);
  EXPECT_THAT(OtherPlaces(found), ElementsAre());
}

TEST(PoolPlacesOfBody, NothingElseHasPlaces) {
  FoundEffect found =
      OneOf("torque_gain", 1, .5, {{FindEffect("torque_gain"), 2, .4}});
  PoolPlacesOfBody(&found);
  EXPECT_EQ(found.probability, .5);
  EXPECT_THAT(OtherPlaces(found), ElementsAre());
  found = OneOf("spring", 1, .5, {{FindEffect("payload"), -1, .4}});
  PoolPlacesOfBody(&found);
  EXPECT_EQ(found.probability, .5);
}

}  // namespace armcal::body_places_test
