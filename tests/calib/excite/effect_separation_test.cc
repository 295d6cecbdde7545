#include "calib/excite/effect_separation.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/fixtures/sample_robots.h"

namespace armcal::effect_separation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class EffectSeparationTest : public testing::Test {
 protected:
  EffectSeparationTest() : robot_(SampleRobot("2R planar (vertical plane)")) {
    std::mt19937_64 random(2);
    SetRandomInertials(&random, &robot_);
    options_.limits = {VectorXd::Constant(2, -2), VectorXd::Constant(2, 2),
                       VectorXd::Constant(2, 3), VectorXd::Constant(2, 15),
                       VectorXd::Constant(2, 900)};
    options_.torque_noise = VectorXd::Constant(2, .2);
    options_.duration_s = 6;
    options_.harmonics = 6;
    options_.starts = 10;
  }
  ModelParameters Model() const {
    ModelParameters::Options options;
    options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb};
    options.transitions.assign(2, {{CoulombTransition::Law::kVelocity, .05}});
    return {robot_, options};
  }
  SeparationQuestion Ask(const std::vector<std::string>& names) const {
    std::vector<const Effect*> effects;
    for (const std::string& name : names) effects.push_back(FindEffect(name));
    return {robot_, effects, Model(), options_.limits};
  }
  EffectSeparation Separate(const std::vector<std::string>& names) const {
    const ModelParameters model = Model();
    return SeparateEffects(robot_, model, Ask(names),
                           MatrixXd::Zero(model.size(), model.size()),
                           options_);
  }

  Robot robot_;
  ExcitationOptions options_;
};

TEST_F(EffectSeparationTest, StepsHelpAndLimitsHold) {
  const EffectSeparation apart = Separate({"elasticity", "delay"});
  ASSERT_GT(apart.motion.numbers.size(), 0);
  EXPECT_LT(apart.motion.criterion, apart.motion.start);
  EXPECT_LE(apart.motion.used, 1);
  ASSERT_EQ(apart.sizes.size(), 3u);  // elasticity of two joints and a delay
  for (const SeparatedSize& size : apart.sizes) {
    EXPECT_GE(size.stddev, size.alone * (1 - 1e-9)) << size.effect;
    EXPECT_GT(size.alone, 0) << size.effect;
  }
}

// What there is one of is as certain beside the others as alone.
TEST_F(EffectSeparationTest, OneEffectOfOneJointHasNoOthers) {
  const EffectSeparation one = Separate({"delay"});
  ASSERT_EQ(one.sizes.size(), 1u);
  EXPECT_NEAR(one.sizes[0].stddev, one.sizes[0].alone,
              1e-6 * one.sizes[0].alone);
}

// Viscous friction is a part of the model: nothing tells them apart.
TEST_F(EffectSeparationTest, WhatTheModelHasCannotBeTold) {
  const EffectSeparation none = Separate({"viscous_friction"});
  EXPECT_EQ(none.motion.numbers.size(), 0);
  EXPECT_NE(none.motion.reason, "");
}

TEST_F(EffectSeparationTest, TheSameAgain) {
  EXPECT_EQ(Separate({"delay", "quadratic_friction"}).motion.numbers,
            Separate({"delay", "quadratic_friction"}).motion.numbers);
}

TEST_F(EffectSeparationTest, RefusesWhatHasNoSize) {
  robot_.gravity.setZero();
  EXPECT_THROW(Ask({"base_tilt"}), std::invalid_argument);
}

}  // namespace armcal::effect_separation_test
