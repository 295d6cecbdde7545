// With a reference of two logs whose offsets differ, which hardly tell it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "calib/diagnose/select/fit.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::held_offsets_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class HeldOffsetsTest : public testing::Test {
 protected:
  HeldOffsetsTest()
      : arm_("2R planar (vertical plane)", 20, .01),
        baseline_(Level(&arm_), {}, VectorXd::Constant(2, 10)) {}

  // In a horizontal plane, where no weight looks like an offset.
  static const Robot& Level(EffectArm* arm) {
    arm->robot.gravity.setZero();
    arm->SetScale();
    return arm->robot;
  }

  // The arm's motion with noise, and an offset of joint 2 (N m).
  GapSegment Recorded(int log, double offset) {
    MatrixXd tau =
        RecordedTorque(arm_.robot, baseline_.transitions(), arm_.motion)
            .nominal();
    AddNoise(&random_, VectorXd::Constant(2, .05), &tau);
    tau.col(1).array() += offset;
    GapSegment segment = MakeSegment(arm_.motion, tau);
    segment.log = log;
    return segment;
  }
  // How far a refit moves the offset of joint 2 for a log that has it, in
  // deviations of its prior, 5 % of Coulomb friction of 1.5 N m; and whether it
  // is chosen.
  std::pair<double, bool> OffsetOf(double offset) {
    GapFitOptions options;
    options.bandwidth_hz = 6;
    GapFit fit(baseline_, options, {Recorded(0, offset)},
               {Recorded(1, -.08), Recorded(2, .08)});
    fit.Choose();
    const auto& effects = fit.refined().effects;
    const bool is_chosen =
        std::any_of(effects.begin(), effects.end(), [](const auto& effect) {
          return effect.effect->name == "torque_offset" && effect.joint == 1;
        });
    for (int c = 0; c < baseline_.size(); ++c) {
      const BaselineColumn& column = baseline_.columns()[c];
      if (column.kind == BaselineColumn::Kind::kTerm && column.joint == 1 &&
          static_cast<JointTerm>(column.index) == JointTerm::kOffset) {
        return {fit.model_refit()[c], is_chosen};
      }
    }
    ADD_FAILURE() << "no offset";
    return {};
  }

  EffectArm arm_;
  GapBaseline baseline_;
  std::mt19937_64 random_{3};
};

// It is the reference's, with one effect in the log.
TEST_F(HeldOffsetsTest, WhatIsFarFromThemIsAnEffect) {
  const auto [moved, is_chosen] = OffsetOf(1);
  EXPECT_LT(std::abs(moved), 3);
  EXPECT_TRUE(is_chosen);
}

// Within what they differ by, it may be any.
TEST_F(HeldOffsetsTest, WhatIsUsualIsNone) {
  EXPECT_FALSE(OffsetOf(.06).second);
}

}  // namespace armcal::held_offsets_test
