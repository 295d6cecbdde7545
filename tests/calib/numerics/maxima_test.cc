#include "calib/numerics/maxima.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace armcal::maxima_tail_test {

// Of exponential maxima as many further ones pass it as it says.
class MaximaTails : public testing::Test {
 protected:
  std::vector<double> Draw(int size) {
    std::vector<double> maxima(size);
    for (double& x : maxima) x = maximum_(random_);
    return maxima;
  }
  template <typename Limit>
  double ShareAbove(Limit limit) {
    int passed = 0;
    for (int i = 0; i < kDraws; ++i) {
      const std::vector<double> further = Draw(kFurther);
      passed += *std::max_element(further.begin(), further.end()) > limit();
    }
    return passed / double(kDraws);
  }
  static constexpr int kDraws = 20000, kFurther = 14;
  std::mt19937_64 random_{1};
  std::exponential_distribution<double> maximum_{.7};
};

// What is held is the expected number of passes, and the median is not known
// exactly either.
TEST_F(MaximaTails, ArePassedAsOftenAsTheySay) {
  for (const double p : {.01, .05}) {
    EXPECT_NEAR(
        ShareAbove([&] { return TailOf(Draw(29)).Quantile(kFurther, p); }), p,
        p / 2);
    EXPECT_LT(ShareAbove([&] {
                return UsualTailOf(Draw(29), 8).Quantile(kFurther, p);
              }),
              1.5 * p);
  }
}

// A fifth of them is something else.
TEST_F(MaximaTails, OfTheUsualDoNotHeedAFew) {
  std::vector<double> maxima = Draw(100);
  const double limit = UsualTailOf(maxima, 8).Quantile(100, .01);
  EXPECT_LT(limit, 40);
  std::fill(maxima.begin(), maxima.begin() + 20, 1000.);
  EXPECT_LT(UsualTailOf(maxima, 8).Quantile(100, .01), 3 * limit);
  EXPECT_GT(TailOf(maxima).Quantile(100, .01), 1000);
}

TEST_F(MaximaTails, HaveTheChanceOfTheirQuantile) {
  const MaximaTail tail = TailOf(Draw(29)), usual = UsualTailOf(Draw(29), 8);
  for (const double p : {.001, .01, .3}) {
    EXPECT_NEAR(tail.Chance(14, tail.Quantile(14, p)), p, 1e-9);
    EXPECT_NEAR(usual.Chance(14, usual.Quantile(14, p)), p, 1e-9);
  }
  EXPECT_EQ(tail.Chance(14, tail.median), 1);
}

TEST_F(MaximaTails, OfTooFewSayNothing) {
  EXPECT_EQ(TailOf({3}).Chance(14, 1e9), 1);
  EXPECT_EQ(UsualTailOf({1, 2, 3, 4, 5, 6, 7}, 8).Chance(14, 1e9), 1);
  EXPECT_TRUE(std::isinf(TailOf({3}).Quantile(14, .01)));
}

// It has to stand out from each.
TEST_F(MaximaTails, TogetherAreAsTheOneThatExpectsMost) {
  const MaximaTail low = TailOf({1, 2, 3, 4}), high = TailOf({1, 4, 9, 12});
  const UsualMaximum usual{5, {low, high}};
  EXPECT_EQ(usual.Quantile(.01), high.Quantile(5, .01));
  EXPECT_EQ(usual.Chance(30), high.Chance(5, 30));
}

}  // namespace armcal::maxima_tail_test
