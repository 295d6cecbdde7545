#include <gtest/gtest.h>

#include <algorithm>

#include "tests/blind/blind_arms.h"
#include "tests/blind/effect_likeness.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::equivalents_test {

BlindCase Scara() {
  for (uint64_t seed = 0;; ++seed) {
    BlindCase blind = DrawBlindCase(seed, PlanCase(Stratum::kNoneRich, 0));
    if (blind.arm != "scara" || blind.points) continue;
    blind.has_reference = false;
    blind.training_s = 12;
    return blind;
  }
}

ChosenEffect Usual(const std::string& name, int joint) {
  const HiddenEffect* kind = FindHiddenEffect(name);
  return {kind, joint, UsualParameters(*kind)};
}

// About an upright axis with nothing below it, all that a link's mass can do is
// to have a moment of inertia, as a motor has: alike but for how the loop
// follows with so much more of it. A spring has none, and what friction does on
// another joint is not felt here.
TEST(EffectLikeness, TheFirstLinkOfAScaraIsAFlywheel) {
  const BlindCase blind = Scara();
  EffectSignals signals(blind);
  EXPECT_TRUE(signals.Add(Usual("armature", 0)));
  EXPECT_TRUE(signals.Add(Usual("link_inertia", 0)));
  EXPECT_TRUE(signals.Add(Usual("spring", 0)));
  EXPECT_TRUE(signals.Add(Usual("stribeck", 0)));
  EXPECT_TRUE(signals.Add(Usual("stribeck", 1)));
  const auto pairs = signals.Alike();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].a.Text(), "armature@1");
  EXPECT_EQ(pairs[0].b.Text(), "link_inertia@1");
  EXPECT_GT(pairs[0].cosine, .99);
}

// Tilts to different sides are one kind: whoever estimates a tilt estimates its
// direction.
TEST(EffectLikeness, ATiltMayHaveAnyDirection) {
  const BlindCase blind = Scara();
  EffectSignals signals(blind);
  ChosenEffect here = Usual("base_tilt", -1), there = here;
  here.parameters[1] = .5;
  there.parameters[1] = 2;
  EXPECT_TRUE(signals.Add(here));
  EXPECT_TRUE(signals.Add(there));
  EXPECT_TRUE(signals.Add(Usual("stribeck", 0)));
  const auto pairs = signals.Alike();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].b.Text(), "base_tilt");
}

TEST(EffectLikeness, NoKindIsLeftOut) {
  const BlindCase blind = Scara();
  const auto effects = EveryEffect(blind);
  for (const HiddenEffect& kind : HiddenEffects()) {
    // A spindle on upright axes and a weight that gravity pulls along them turn
    // no joint.
    if (kind.name == "gyroscope" || kind.name == "loose_bolt") continue;
    EXPECT_TRUE(std::any_of(
        effects.begin(), effects.end(),
        [&kind](const ChosenEffect& effect) { return effect.kind == &kind; }))
        << kind.name;
  }
}

TEST(Equivalents, HoldBothWaysOnTheirArm) {
  const Equivalents equivalents(WriteFile(
      R"({"scara": [{"a": {"effect": "armature", "joint_index": 1},
                     "b": {"effect": "link_inertia", "joint_index": 1},
                     "cosine": 0.99}]})",
      "equivalents.json"));
  const NamedEffect armature{"armature", 1}, link{"link_inertia", 1};
  EXPECT_TRUE(equivalents.Hold("scara", armature, link));
  EXPECT_TRUE(equivalents.Hold("scara", link, armature));
  EXPECT_FALSE(equivalents.Hold("puma", link, armature));
  EXPECT_FALSE(equivalents.Hold("scara", {"link_inertia", 2}, armature));
}

// The file that comes with the bench speaks of its arms and effects.
TEST(Equivalents, OfTheBenchAreOfItsArms) {
  const Equivalents equivalents(DATA_DIR "/../tests/blind/equivalents.json");
  EXPECT_FALSE(equivalents.arms().empty());
  for (const auto& [arm, pairs] : equivalents.arms()) {
    const auto& names = BlindArmNames();
    EXPECT_EQ(std::count(names.begin(), names.end(), arm), 1) << arm;
    for (const Equivalents::Pair& pair : pairs) {
      EXPECT_GE(pair.cosine, kAlike);
      EXPECT_TRUE(FindHiddenEffect(pair.a.effect)) << pair.a.effect;
      EXPECT_TRUE(FindHiddenEffect(pair.b.effect)) << pair.b.effect;
    }
  }
}

}  // namespace armcal::equivalents_test
