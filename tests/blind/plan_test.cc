#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "tests/blind/case_plan.h"
#include "tests/blind/size_search.h"

namespace armcal::plan_test {

// What issue 5 asks for: 150 rich and 60 poor without effect, 250 with one, 60
// with two, 60 out of catalogue; every effect 6 times at ENR 0.32 or more and
// twice at 0.17 to 0.32.
TEST(CasePlan, EvaluationHasTheCasesAskedFor) {
  std::map<Stratum, int> strata;
  std::map<std::string, int> large, small, outside;
  std::set<Excitation> excitations;
  for (uint32_t k = 0; k < EvaluationCases(); ++k) {
    const CasePlan plan = PlanCase(k);
    ++strata[plan.stratum];
    excitations.insert(plan.excitation);
    if (plan.stratum == Stratum::kOne) {
      ASSERT_TRUE(plan.effect->in_catalogue);
      ++(plan.lowest_bin >= 2 ? large : small)[plan.effect->name];
    }
    if (plan.stratum == Stratum::kOutside) {
      ASSERT_FALSE(plan.effect->in_catalogue);
      ++outside[plan.effect->name];
    }
    if (plan.stratum == Stratum::kTwo) {
      EXPECT_GE(plan.lowest_bin, 2);
    }
  }
  EXPECT_EQ(strata[Stratum::kNoneRich], 150);
  EXPECT_EQ(strata[Stratum::kNonePoor], 60);
  EXPECT_GE(strata[Stratum::kOne], 250);
  EXPECT_EQ(strata[Stratum::kTwo], 60);
  EXPECT_EQ(strata[Stratum::kOutside], 60);
  EXPECT_EQ(excitations.size(), 4u);
  EXPECT_EQ(large.size(), 35u);
  for (const auto& [name, count] : large) EXPECT_GE(count, 6) << name;
  for (const auto& [name, count] : large) EXPECT_EQ(small[name], 2) << name;
  EXPECT_EQ(outside.size(), 13u);
}

// As stratum one has them: nine cases, of which two are faint.
TEST(CasePlan, OfOneEffectAlone) {
  const HiddenEffect& elasticity = *FindHiddenEffect("elasticity");
  int faint = 0;
  std::set<Excitation> excitations;
  for (uint32_t k = 0; k < 9; ++k) {
    const CasePlan plan = PlanCase(elasticity, k);
    EXPECT_EQ(plan.stratum, Stratum::kOne);
    EXPECT_EQ(plan.effect, &elasticity);
    faint += plan.lowest_bin < 2;
    excitations.insert(plan.excitation);
  }
  EXPECT_EQ(faint, 2);
  EXPECT_GT(excitations.size(), 1u);
}

// Any stretch of 100 cases has its share of each stratum, to a case or two.
TEST(CasePlan, EveryStretchHasItsShares) {
  for (const uint32_t first : {0u, 150u, 500u, 1000u}) {
    std::map<Stratum, int> strata;
    for (uint32_t k = first; k < first + 100; ++k)
      ++strata[PlanCase(k).stratum];
    EXPECT_NEAR(strata[Stratum::kNoneRich], 15000. / 645, 2);
    EXPECT_NEAR(strata[Stratum::kNonePoor], 6000. / 645, 2);
    EXPECT_NEAR(strata[Stratum::kOne], 31500. / 645, 2);
  }
}

TEST(CasePlan, BinsMeetAtTheirEdges) {
  EXPECT_EQ(EnrBin(0), 0);
  EXPECT_EQ(EnrBin(.169), 0);
  EXPECT_EQ(EnrBin(.17), 1);
  EXPECT_EQ(EnrBin(.32), 2);
  EXPECT_EQ(EnrBin(2.9), 3);
  EXPECT_EQ(EnrBin(1e9), 4);
}

// Searches on laws of ENR over size that are known.
struct Law {
  std::function<double(double size)> enr;  // negative: the arm does not follow
  int calls = 0;

  FoundSize Find(const std::string& effect, const SizeAim& aim) {
    const HiddenEffect* kind = FindHiddenEffect(effect);
    const auto found = FindSize(
        {kind, 0, UsualParameters(*kind)}, aim,
        [this](const ChosenEffect& chosen) -> std::optional<EffectSize> {
          ++calls;
          const double value = enr(std::abs(chosen.parameters[0]));
          if (value < 0) return std::nullopt;
          EffectSize size;
          size.enr = value;
          return size;
        });
    return found ? *found : FoundSize{{}, {}, "nothing"};
  }
};

TEST(SizeSearch, ALineNeedsTwoRuns) {
  Law law{[](double size) { return 100 * size; }};
  const FoundSize found = law.Find("stribeck", {.5, .32, 1});
  EXPECT_NEAR(found.effect.parameters[0], .005, 1e-9);
  EXPECT_EQ(law.calls, 2);
  EXPECT_EQ(found.limit, "");
}

TEST(SizeSearch, FindsTheBinOfASteepLawThatFalls) {
  Law law{[](double limit) { return std::pow(3 / limit, 6); }};
  const FoundSize found = law.Find("torque_saturation", {.5, .32, 1});
  EXPECT_GT(found.effect.parameters[0], 3);
  EXPECT_GE(found.size.enr, .32);
  EXPECT_LT(found.size.enr, 1);
  EXPECT_LE(law.calls, kMostSizes);
}

TEST(SizeSearch, KeepsTheLargestWhereTheRangeEnds) {
  Law law{[](double size) { return .01 * size; }};
  const FoundSize found = law.Find("stribeck", {.5, .32, 1});
  EXPECT_DOUBLE_EQ(found.effect.parameters[0], 1);
  EXPECT_EQ(found.limit, "no more than friction 1");
}

TEST(SizeSearch, StaysWhereTheArmFollows) {
  Law law{[](double size) { return size > .1 ? -1 : 2 * size; }};
  const FoundSize found = law.Find("stribeck", {.5, .32, 1});
  EXPECT_LE(found.effect.parameters[0], .1);
  EXPECT_GT(found.effect.parameters[0], .08);
  EXPECT_EQ(found.limit.find("the arm does not follow its motion at friction"),
            0u)
      << found.limit;
  law.enr = [](double) { return -1; };
  EXPECT_EQ(law.Find("stribeck", {.5, .32, 1}).limit, "nothing");
}

}  // namespace armcal::plan_test
