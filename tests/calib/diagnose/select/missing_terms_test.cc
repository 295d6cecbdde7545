#include "calib/diagnose/select/missing_terms.h"

#include <cmath>
#include <random>

#include "tests/fixtures/diagnosed_arm.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::missing_terms_test {

using MissingTermsTest = DiagnosedArm<32>;

Robot WithoutFriction(Robot robot) {
  for (Link& link : robot.links) link.joint.viscous = link.joint.coulomb = 0;
  return robot;
}

TEST_F(MissingTermsTest, AFrictionlessFileLacksFrictionOnAllJoints) {
  const GapDiagnosis diagnosis = Diagnose(WithoutFriction(File()));
  for (const auto& [effect, name, truth] :
       {std::make_tuple("viscous_friction", ".viscous", .8),
        std::make_tuple("coulomb_friction", ".coulomb", 1.5)}) {
    SCOPED_TRACE(effect);
    const auto found =
        std::find_if(diagnosis.effects.begin(), diagnosis.effects.end(),
                     [wanted = effect](const FoundEffect& f) {
                       return f.effect->name == wanted;
                     });
    ASSERT_NE(found, diagnosis.effects.end());
    EXPECT_EQ(found->joint, -1);
    ASSERT_EQ(found->estimates.size(), 2u);
    for (const Link& link : File().links) {
      ExpectEstimate(*found, link.joint.name + name, truth, .05);
    }
  }
  // Every step of the ladder leaves less, the last little.
  const MissingTerms& ladder = diagnosis.ladder;
  ASSERT_GE(ladder.terms.size(), 2u);
  EXPECT_LT(ladder.terms[0].left.norm(), .8 * ladder.without.norm());
  EXPECT_LT(ladder.terms[1].left.norm(), .3 * ladder.terms[0].left.norm());
}

// What a spring took for friction of the fit without it, friction gives back:
// the file says nothing of it that the fit had to stay near to.
TEST_F(MissingTermsTest, AreToldAsTheyAreGivenTheEffects) {
  Add("spring", 1, {12, 3});
  const GapDiagnosis diagnosis = Diagnose(WithoutFriction(File()));
  const auto told = [&](const std::string& effect) {
    const auto found = std::find_if(
        diagnosis.effects.begin(), diagnosis.effects.end(),
        [&](const FoundEffect& f) { return f.effect->name == effect; });
    EXPECT_NE(found, diagnosis.effects.end()) << effect;
    return *found;
  };
  EXPECT_EQ(told("spring").joint, 1);
  const FoundEffect coulomb = told("coulomb_friction");
  const MissingTerms& ladder = diagnosis.ladder;
  const auto first = std::find_if(
      ladder.terms.begin(), ladder.terms.end(),
      [](const MissingTerm& f) { return f.joint_term == JointTerm::kCoulomb; });
  ASSERT_NE(first, ladder.terms.end());
  for (int j = 0; j < 2; ++j) {
    ExpectEstimate(coulomb, File().links[j].joint.name + ".coulomb", 1.5, .05);
  }
  EXPECT_GT(std::abs(first->value[1] - 1.5), .15);
}

TEST_F(MissingTermsTest, AFileWithFrictionLacksNone) {
  EXPECT_TRUE(Diagnose(File()).ladder.terms.empty());
}

// Not all that a file leaves out is there: this arm has no offsets, and the
// armature that its file has.
TEST_F(MissingTermsTest, WhatTheRobotDoesNotHaveEitherIsNotMissing) {
  Robot file = WithoutFriction(File());
  for (const MissingTerm& term : Diagnose(file).ladder.terms) {
    EXPECT_THAT(term.effect->name,
                testing::AnyOf("viscous_friction", "coulomb_friction"));
  }
}

// There and back at one speed, in which viscous and Coulomb friction are one
// torque and its sign: given one of them nothing asks for the other, which is
// no reason to have neither. The arm has dry friction alone, its file none.
TEST(FitMissingTerms, HasOneOfTwoThatLookAlike) {
  constexpr double kStep = .01, kRound = 2.5, kSpeed = 1;  // s, s, rad/s
  constexpr int kSize = 1000;
  const EffectArm arm("2R planar (vertical plane)", 8, kStep);
  Motion motion = arm.motion;
  motion.stamp_error.resize(0);
  motion.q.resize(kSize, 2);
  motion.qd.resize(kSize, 2);
  motion.qdd.setZero(kSize, 2);
  Eigen::MatrixXd tau(kSize, 2);
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0, .4);
  for (int k = 0; k < kSize; ++k) {
    const double phase = std::fmod(k * kStep / kRound, 1);
    const double speed = phase < .5 ? kSpeed : -kSpeed;
    motion.qd.row(k) << speed, -speed;
    const double way = kSpeed * kRound * (phase < .5 ? phase : 1 - phase);
    motion.q.row(k) << way, -way;
    for (int j = 0; j < 2; ++j) {
      tau(k, j) = noise(random) + 1.5 * (motion.qd(k, j) > 0 ? 1 : -1);
    }
  }
  const Robot file = WithoutFriction(arm.robot);
  const GapBaseline baseline(file, {}, Eigen::VectorXd::Constant(2, 10));
  tau += RecordedTorque(file, baseline.transitions(), motion).nominal();
  const MissingTerms missing =
      FitMissingTerms(file, {}, 6, {MakeSegment(motion, tau)});
  ASSERT_EQ(missing.terms.size(), 1u);
  EXPECT_THAT(missing.terms[0].effect->name,
              testing::AnyOf("viscous_friction", "coulomb_friction"));
  EXPECT_LT(missing.terms[0].left.norm(), .5 * missing.without.norm());
}

// With a log from before, it is no news that the file had none.
TEST_F(MissingTermsTest, AreNoEffectGivenAReference) {
  const GapDiagnosis diagnosis = Diagnose(WithoutFriction(File()), true);
  EXPECT_GE(diagnosis.ladder.terms.size(), 2u);
  EXPECT_TRUE(diagnosis.effects.empty());
}

}  // namespace armcal::missing_terms_test
