#include "calib/diagnose/judge/probability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/effects/effects.h"

namespace armcal::probability_test {

PlacedEffect Scored(const char* effect, double score) {
  return {FindEffect(effect), 0, 0, score};
}

// A rival whose torque is not finite has no score: the others' probabilities
// are what they are without it.
TEST(ByScore, WhatHasNoFiniteScoreIsNoRival) {
  const auto all =
      ByScore({Scored("spring", 90), Scored("stribeck", NAN),
               Scored("delay", -INFINITY), Scored("elasticity", 100)});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].effect->name, "elasticity");
  EXPECT_EQ(all[1].effect->name, "spring");
  EXPECT_NEAR(all[0].probability + all[1].probability, 1, 1e-12);
  EXPECT_NEAR(all[0].probability / all[1].probability,
              std::exp(10 / (2 * Limits().temperature)), 1e-9);
}

TEST(ByScore, OfNoneIsNone) {
  EXPECT_TRUE(ByScore({Scored("spring", NAN)}).empty());
}

}  // namespace armcal::probability_test
