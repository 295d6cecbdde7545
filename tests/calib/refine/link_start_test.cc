#include "calib/refine/link_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_robots.h"

namespace armcal::link_start_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A body, a free term, one that is held at 0 and one that is held at .7, of
// equations in which all of them matter.
TEST(StartLinks, KeepsWhatIsHeldToTheLastDigit) {
  std::mt19937_64 random(4);
  VectorXd x(13);
  x << 2, .1, 0, .2, .06, .06, .05, 0, 0, -.01, .3, 0, .7;
  MatrixXd R(40, x.size());
  for (Eigen::Index k = 0; k < R.cols(); ++k) {
    R.col(k) = UniformVector(&random, 40, -1, 1);
  }
  const VectorXd z = UniformVector(&random, 40, -5, 5);
  const auto end = StartLinks(
      R, z, .5, {TermRange::kFree, TermRange::kHeld, TermRange::kHeld}, x);
  ASSERT_TRUE(end);
  EXPECT_EQ((*end)[11], 0);
  EXPECT_EQ((*end)[12], .7);
  EXPECT_GT(std::abs((*end)[10] - .3), .01);
}

}  // namespace armcal::link_start_test
