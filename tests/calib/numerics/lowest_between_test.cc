#include "calib/numerics/lowest_between.h"

#include <gtest/gtest.h>

namespace armcal::lowest_between_test {

// Of 3 (x - .3)^2 + 2 at -1, 0 and 1.
TEST(LowestBetween, IsTheVertexOfAParabola) {
  EXPECT_NEAR(LowestBetween(7.07, 2.27, 3.47), .3, 1e-12);
}

TEST(LowestBetween, IsTheMiddleWhereNothingIsLeast) {
  EXPECT_EQ(LowestBetween(1, 2, 1.5), 0);
  EXPECT_EQ(LowestBetween(1, 2, 3), 0);
}

}  // namespace armcal::lowest_between_test
