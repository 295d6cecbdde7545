#include "calib/diagnose/select/growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "calib/diagnose/select/fit.h"
#include "model/effects/effects.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::growth_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 6;  // Hz

// An arm of which each joint's torque but the first's is off by three standard
// deviations of its white noise, and the first's by 40 of one that hardly
// changes from sample to sample, so that few of its rows are independent.
class GrowthTest : public testing::Test {
 protected:
  GrowthTest()
      : arm_("PUMA560 6R", 30, .01),
        baseline_(arm_.robot, {}, VectorXd::Constant(6, 10)) {}

  MatrixXd Torque() {
    MatrixXd tau =
        RecordedTorque(arm_.robot, baseline_.transitions(), arm_.motion)
            .nominal();
    constexpr double kKept = .995;
    VectorXd last = VectorXd::Zero(6);
    for (Eigen::Index k = 0; k < tau.rows(); ++k) {
      for (int j = 0; j < 6; ++j) {
        const double kept = j == 0 ? kKept : 0;
        last[j] =
            kept * last[j] + std::sqrt(1 - kept * kept) * .5 * Normal(&random_);
        tau(k, j) += last[j] + (j == 0 ? 20 : 1.5);
      }
    }
    return tau;
  }

  EffectArm arm_;
  GapBaseline baseline_;
  std::mt19937_64 random_{11};
};

TEST_F(GrowthTest, WhatIsMostOfTheGapIsAmongTheFewThatAreChosen) {
  GapFitOptions options;
  options.bandwidth_hz = kBandwidth;
  GapFit fit(baseline_, options, {MakeSegment(arm_.motion, Torque())}, {});
  fit.Choose();
  const std::vector<GapCandidate>& effects = fit.refined().effects;
  ASSERT_FALSE(effects.empty());
  const auto is_it = [](const GapCandidate& effect) {
    return effect.joint == 0 && effect.effect->name == "torque_offset";
  };
  EXPECT_EQ(std::count_if(effects.begin(), effects.end(), is_it), 1);
}

}  // namespace armcal::growth_test
