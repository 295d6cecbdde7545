#include "calib/watch/two_pole.h"

#include <gmock/gmock.h>

namespace armcal::two_pole_test {

using Eigen::MatrixXd;

MatrixXd Value(double value) { return MatrixXd::Constant(1, 1, value); }

// The step response 1 - (1 + Kt) exp(-Kt) of K^2 / (s + K)^2 (any table of
// Laplace transforms), and its derivative K^2 t exp(-Kt).
TEST(TwoPole, StepResponse) {
  TwoPole filter(10);
  filter.Start(Value(0));
  filter.Step(1e-9, Value(1));
  filter.Step(.13, Value(1));
  EXPECT_NEAR(filter.value()(0, 0), 1 - 2.3 * std::exp(-1.3), 1e-7);
  EXPECT_NEAR(filter.rate()(0, 0), 100 * .13 * std::exp(-1.3), 1e-6);
}

// A straight line is followed 2 / K late, in steps of any size, and steps do
// not add errors: two are one.
TEST(TwoPole, StraightLinesAreExactWhateverTheSteps) {
  TwoPole once(20), twice(20);
  once.Start(Value(0));
  twice.Start(Value(0));
  for (int k = 1; k <= 40; ++k) {
    once.Step(.1, Value(.1 * k));
    twice.Step(.03, Value(.1 * (k - 1) + .03));
    twice.Step(.07, Value(.1 * k));
    ASSERT_NEAR(once.value()(0, 0), twice.value()(0, 0), 1e-12);
    ASSERT_NEAR(once.rate()(0, 0), twice.rate()(0, 0), 1e-11);
  }
  EXPECT_NEAR(once.value()(0, 0), 4 - once.delay(), 1e-12);
  EXPECT_NEAR(once.rate()(0, 0), 1, 1e-12);
}

}  // namespace armcal::two_pole_test
