#include <gtest/gtest.h>

#include "tests/blind/sized_case.h"

namespace armcal::cases_long_test {

// Calibration cases of two kinds of arm: their effects have the planned
// visibility, by runs that the search had no part in, or a reason why not.
TEST(SizedCase, IsAsVisibleAsPlanned) {
  constexpr int kCases = 6;
  int checked = 0, as_planned = 0;
  for (uint32_t k = 0; checked < kCases; ++k) {
    const uint64_t seed = BlindCaseSeed(BlindSet::kCalibration, 4242, k);
    const CasePlan plan = PlanCase(Stratum::kOne, 5 * k);
    const BlindCase first = DrawBlindCase(seed, plan);
    if (first.arm != "elbow" && first.arm != "scara") continue;
    ++checked;
    const SizedCase sized = DrawSizedCase(seed, plan);
    ASSERT_EQ(sized.sizes.size(), 1u);
    const int bin = EnrBin(sized.sizes[0].enr);
    const bool planned = bin >= plan.lowest_bin && bin <= plan.highest_bin;
    EXPECT_EQ(planned, sized.limits[0].empty()) << plan.effect->name;
    as_planned += planned;
    const auto again = EffectSizes(sized.blind);
    ASSERT_TRUE(again);
    EXPECT_NEAR((*again)[0].enr, sized.sizes[0].enr, 1e-6 * sized.sizes[0].enr);
    EXPECT_EQ(sized.training.effects[0].name, plan.effect->name);
  }
  EXPECT_GE(as_planned, kCases - 2);
}

// Of two effects each is visible beside the other.
TEST(SizedCase, OfTwoEffects) {
  for (uint32_t k = 0;; ++k) {
    const uint64_t seed = BlindCaseSeed(BlindSet::kCalibration, 4243, k);
    const CasePlan plan = PlanCase(Stratum::kTwo, k);
    if (DrawBlindCase(seed, plan).arm != "elbow") continue;
    const SizedCase sized = DrawSizedCase(seed, plan);
    ASSERT_EQ(sized.sizes.size(), 2u);
    EXPECT_NE(sized.blind.effects[0].kind, sized.blind.effects[1].kind);
    for (int e = 0; e < 2; ++e) {
      EXPECT_TRUE(sized.sizes[e].enr >= .32 || !sized.limits[e].empty());
    }
    return;
  }
}

}  // namespace armcal::cases_long_test
