#include "calib/diagnose/impossible_terms.h"

#include <gtest/gtest.h>

#include "tests/calib/diagnose/sample_diagnosis.h"

namespace armcal::impossible_terms_test {

class ImpossibleTermsTest : public testing::Test {
 protected:
  ImpossibleTermsTest() {
    diagnosis_.effects = {MakeFound("armature", -1)};
    diagnosis_.effects[0].fitted.clear();
    diagnosis_.moved = {
        {"elbow.armature", "kg m^2", 0, -.12, .01, 3, JointTerm::kArmature}};
  }
  std::vector<DataFinding> Told() const {
    return TellImpossibleTerms(diagnosis_.effects, diagnosis_.moved);
  }

  GapDiagnosis diagnosis_ = SampleDiagnosis();
};

TEST_F(ImpossibleTermsTest, ArmatureBelowZeroLeads) {
  const auto told = Told();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(told[0].leads);
  EXPECT_EQ(told[0].finding,
            "elbow.armature (-0.12 +- 0.01 kg m^2) is below zero, which no "
            "joint has");
}

TEST_F(ImpossibleTermsTest, NotWithinItsDeviations) {
  diagnosis_.moved[0].stddev = .04;
  EXPECT_TRUE(Told().empty());
}

// Coulomb friction is below zero on one joint where its law is another one.
TEST_F(ImpossibleTermsTest, NotWhereAnotherJointHasIt) {
  diagnosis_.moved.push_back(
      {"shoulder.armature", "kg m^2", 0, .3, .01, 3, JointTerm::kArmature});
  EXPECT_TRUE(Told().empty());
}

TEST_F(ImpossibleTermsTest, NotOfWhatIsNotNamed) {
  diagnosis_.effects[0] = MakeFound("viscous_friction", -1);
  diagnosis_.effects[0].fitted.clear();
  EXPECT_TRUE(Told().empty());
}

// An effect that was fitted is a change, or what a term's joints differ by.
TEST_F(ImpossibleTermsTest, NotOfChanges) {
  diagnosis_.effects[0].fitted = {0};
  EXPECT_TRUE(Told().empty());
}

}  // namespace armcal::impossible_terms_test
