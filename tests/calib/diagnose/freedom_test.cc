// What a file was taken for, and what the logs make of that.

#include "calib/diagnose/freedom.h"

#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::freedom_test {

class FreedomTest : public DiagnosedArm<32> {
 protected:
  FreedomTest() { may_trust_less_ = true; }

  // A guess: each link's mass, centre and inertia wrong by other factors.
  Robot RoughFile() const {
    Robot file = File();
    InertialParameters& first = file.links[0].inertial;
    InertialParameters& second = file.links[1].inertial;
    first.inertia *= 1.5;
    first.first_moment *= 1.3;
    second.inertia *= .6;
    second.first_moment *= .7;
    return file;
  }
};

// No single effect is what is wrong with it.
TEST_F(FreedomTest, ARoughFileIsTrustedLess) {
  const GapDiagnosis diagnosis = Diagnose(RoughFile());
  EXPECT_GT(diagnosis.trust, .05);
  EXPECT_TRUE(diagnosis.effects.empty());
}

TEST_F(FreedomTest, AGoodFileIsTrustedAsBefore) {
  EXPECT_EQ(Diagnose(File()).trust, .05);
}

// One column for what is there costs less than freedom for all links, which
// would not explain it either.
TEST_F(FreedomTest, ASpringIsNoRoughFile) {
  Add("spring", 1, {12, 3});
  const GapDiagnosis diagnosis = Diagnose(File());
  EXPECT_EQ(diagnosis.trust, .05);
  ExpectFirst(diagnosis, "spring", 1);
}

TEST_F(FreedomTest, WhatTheUserSaysStands) {
  may_trust_less_ = false;
  EXPECT_EQ(Diagnose(RoughFile()).trust, .05);
}

// The file gives no armature, and a first link that is heavier than the true
// one: torques ask for less inertia than that, which no motor has.
TEST_F(FreedomTest, NoMotorHasNegativeInertia) {
  may_trust_less_ = false;
  Robot file = File();
  for (Link& link : file.links) link.joint.armature = 0;
  file.links[0].inertial.inertia *= 8;
  const GapDiagnosis diagnosis = Diagnose(file);
  const auto armature = std::find_if(
      diagnosis.effects.begin(), diagnosis.effects.end(),
      [](const FoundEffect& f) { return f.effect->name == "armature"; });
  ASSERT_NE(armature, diagnosis.effects.end());
  ASSERT_EQ(armature->estimates.size(), 1u);
  ExpectEstimate(*armature, File().links[1].joint.name + ".armature", .2, .3);
}

}  // namespace armcal::freedom_test
