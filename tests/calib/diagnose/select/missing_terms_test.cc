#include "calib/diagnose/select/missing_terms.h"

#include "tests/fixtures/diagnosed_arm.h"

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

// With a log from before, it is no news that the file had none.
TEST_F(MissingTermsTest, AreNoEffectGivenAReference) {
  const GapDiagnosis diagnosis = Diagnose(WithoutFriction(File()), true);
  EXPECT_GE(diagnosis.ladder.terms.size(), 2u);
  EXPECT_TRUE(diagnosis.effects.empty());
}

}  // namespace armcal::missing_terms_test
