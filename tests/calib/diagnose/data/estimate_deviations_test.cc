#include "calib/diagnose/data/estimate_deviations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/effect_arm.h"

namespace armcal::estimate_deviations_test {

// Of an effect with one parameter, which is fitted to .01, read off torques
// whose scale is known to 2 %.
double DeviationOf(const std::string& name, int joint, double value) {
  const EffectArm arm("UR5 6R", 4, .01);
  return EstimateDeviations(*FindEffect(name), arm.Site(joint),
                            Eigen::VectorXd::Constant(1, value),
                            Eigen::MatrixXd::Constant(1, 1, 1e-4), .02)[0];
}

// Friction of 5 N m s/rad is off by 2 % of that, a time by nothing.
TEST(EstimateDeviations, OfWhatHasAMassInItsDimension) {
  EXPECT_NEAR(DeviationOf("viscous_friction", 1, 5), std::hypot(.01, .1), 1e-9);
  EXPECT_NEAR(DeviationOf("delay", -1, 5), .01, 1e-9);
}

// Torques that are 1 + 1 times what they were, to 2 % of that.
TEST(EstimateDeviations, OfFactorsOfTheTorque) {
  for (const char* name :
       {"torque_gain_of_all_joints", "viscous_friction_of_all_joints"}) {
    EXPECT_NEAR(DeviationOf(name, -1, 1), std::hypot(.01, .04), 1e-9) << name;
  }
  EXPECT_NEAR(DeviationOf("torque_gain", 1, 1), std::hypot(.01, .04), 1e-9);
  EXPECT_NEAR(DeviationOf("torque_gain", 1, -.5), std::hypot(.01, .01), 1e-9);
}

}  // namespace armcal::estimate_deviations_test
