#include <cmath>

#include "calib/diagnose/diagnosis.h"
#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::diagnosis_long_test {

using Eigen::VectorXd;
using testing::IsEmpty;

using GapDiagnosisLongTest = DiagnosedArm<62>;

TEST_F(GapDiagnosisLongTest, NothingIsMissing) {
  const GapDiagnosis diagnosis = Diagnose(File());
  EXPECT_THAT(diagnosis.effects, IsEmpty());
  // The file does not say how friction passes zero velocity.
  EXPECT_THAT(GapVerdictName(diagnosis.verdict),
              testing::AnyOf(testing::StrEq("noise_floor"),
                             testing::StrEq("absorbed")));
  EXPECT_EQ(diagnosis.floor, NoiseFloor::kRepeats);
  EXPECT_NEAR(diagnosis.torque.after, 1, .4);
}

// By twice what the file is trusted to.
TEST_F(GapDiagnosisLongTest, OnlyTheFilesNumbersWereWrong) {
  Robot file = File();
  for (Link& link : file.links) {
    link.inertial +=
        InertialParameters::FromVector(.08 * link.inertial.ToVector());
    link.joint.viscous *= .9;
    link.joint.coulomb *= 1.1;
  }
  const GapDiagnosis diagnosis = Diagnose(file);
  EXPECT_THAT(diagnosis.effects, IsEmpty());
  EXPECT_STREQ(GapVerdictName(diagnosis.verdict), "absorbed");
  EXPECT_GT(diagnosis.torque.nominal, 3);
  EXPECT_NEAR(diagnosis.torque.refit, 1, .4);
}

// What a trusted file is far off in is an effect, not an error.
TEST_F(GapDiagnosisLongTest, AParameterIsFarFromATrustedFiles) {
  Robot file = File();
  file.links[1].joint.viscous = .4;  // .8
  const GapDiagnosis diagnosis = Diagnose(file);
  ExpectFirst(diagnosis, "viscous_friction", 1);
  ExpectEstimate(diagnosis.effects[0], "viscous", .4, .05);
}

// By this many times the least compliance that is tried.
class YieldingGear : public GapDiagnosisLongTest,
                     public testing::WithParamInterface<double> {};

TEST_P(YieldingGear, IsFound) {
  const EffectSite site = plant_->arm().Site(1);
  const Effect& elasticity = *FindEffect("elasticity");
  VectorXd p(elasticity.parameters.size());
  for (int k = 0; k < p.size(); ++k) p[k] = elasticity.parameters[k].size(site);
  p[0] *= GetParam();
  Add("elasticity", 1, {p.begin(), p.end()});
  const GapDiagnosis diagnosis = Diagnose(File());
  ExpectFirst(diagnosis, "elasticity", 1);
  ExpectEstimate(diagnosis.effects[0], "stiffness", 1 / p[0], .1);
}

INSTANTIATE_TEST_SUITE_P(Compliances, YieldingGear,
                         testing::Values(13, 40, 120));

TEST_F(GapDiagnosisLongTest, TwoAreFound) {
  Add("stribeck", 0, {1.5, .14});
  Add("torque_ripple", 1, {1, .5, 23});
  const GapDiagnosis diagnosis = Diagnose(File());
  ASSERT_EQ(diagnosis.effects.size(), 2u);
  std::vector<std::string> places;
  for (const FoundEffect& found : diagnosis.effects) {
    places.push_back(found.effect->name + std::to_string(found.joint));
  }
  EXPECT_THAT(places,
              testing::UnorderedElementsAre("stribeck0", "torque_ripple1"));
}

// 9 Hz, of which samples thinned to 15 Hz know only that it may be 6.
TEST_F(GapDiagnosisLongTest, AVibrationBeyondTheBandwidthIsItself) {
  Add("vibration", 0, {2, 1, 9});
  const GapDiagnosis diagnosis = Diagnose(File());
  ExpectFirst(diagnosis, "vibration", 0);
  ExpectEstimate(diagnosis.effects[0], "frequency", 9, .001);
  ExpectEstimate(diagnosis.effects[0], "amplitude", std::sqrt(5.), .1);
}

// A torque that no catalogue has: of the product of two joints' positions.
TEST_F(GapDiagnosisLongTest, WhatHasNoNameIsUnknown) {
  truth_.joint_laws.push_back(
      {0, {}, false, [](const ArmInstant& at, const double*, double*) {
         return 2 * std::sin(9 * at.position[1]) * std::cos(7 * at.position[0]);
       }});
  const GapDiagnosis diagnosis = Diagnose(File());
  EXPECT_THAT(diagnosis.verdict, testing::AnyOf(GapVerdict::kUnknown,
                                                GapVerdict::kPartlyExplained));
  EXPECT_EQ(diagnosis.unexplained.joint, "joint1");
  EXPECT_GT(diagnosis.unexplained.share, .3);
}

}  // namespace armcal::diagnosis_long_test
