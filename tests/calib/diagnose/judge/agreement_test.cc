#include "calib/diagnose/judge/agreement.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "model/signals/delayed_signal.h"
#include "tests/fixtures/diagnosed_arm.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::agreement_test {

// Quantiles of chi squared: 5 degrees exceed 18.2 once in 370 times.
TEST(AgreementTest, JointsDifferBeyondChance) {
  EXPECT_FALSE((Agreement{17, 50, 5}.Differ(.2)));
  EXPECT_TRUE((Agreement{20, 50, 5}.Differ(.2)));
}

// What the form of a large effect has wrong differs from joint to joint.
TEST(AgreementTest, JointsAgreeWithinAnErrorOfForm) {
  EXPECT_FALSE((Agreement{20, 1000, 5}.Differ(.2)));
}

TEST(AgreementTest, OneJointCannotDiffer) {
  EXPECT_FALSE((Agreement{100, 50, 0}.Differ(.2)));
}

// Of two that move, the other would have seen a clock that is wrong.
TEST(AgreementTest, OneOfSeveralJointsIsNotAll) {
  EXPECT_TRUE((Agreement{0, 0, 0, 2, 1}.IsOfOneJoint()));
  EXPECT_FALSE((Agreement{0, 0, 0, 2, 2}.IsOfOneJoint()));
  EXPECT_FALSE((Agreement{0, 0, 0, 1, 1}.IsOfOneJoint()));
}

// Of a few milliseconds a refit takes up all but what its prior says: it is
// seen by both joints nevertheless.
class AgreementOnTest : public DiagnosedArm<32> {};

TEST_F(AgreementOnTest, ADelayIsSeenGivenTheBaselinesOwn) {
  Add("delay", -1, {.006});
  const GapDiagnosis diagnosis = Diagnose(File());
  ASSERT_FALSE(diagnosis.effects.empty());
  EXPECT_EQ(diagnosis.effects[0].effect->name, "delay");
  ExpectEstimate(diagnosis.effects[0], "delay", .006, .1);
}

// A column is a small delay's; what a large one differs from it by is no
// disagreement of joints.
TEST(AgreementOn, JointsAgreeAboutALargeDelay) {
  constexpr double kDelay = .05;  // s
  const EffectArm arm("2R planar (vertical plane)", 30, .005);
  const GapBaseline baseline(arm.robot, {}, Eigen::VectorXd::Constant(2, 10));
  Eigen::MatrixXd tau = Delayed(
      RecordedTorque(arm.robot, baseline.transitions(), arm.motion).nominal(),
      kDelay / arm.motion.dt);
  std::mt19937_64 random(2);
  AddNoise(&random, Eigen::VectorXd::Constant(2, .05), &tau);
  GapFitOptions options;
  options.bandwidth_hz = 6;
  GapFit fit(baseline, options, {MakeSegment(arm.motion, tau)}, {});
  fit.Choose();
  const std::vector<GapCandidate>& found = fit.refined().effects;
  ASSERT_FALSE(found.empty());
  ASSERT_EQ(found[0].effect->name, "delay");
  const Agreement agreement = AgreementOn(fit, 0);
  EXPECT_EQ(agreement.seen_by, 2);
  // 2.6e-5 by what columns leave instead of what the delay does.
  EXPECT_LT(agreement.chi_squared, 5e-6 * agreement.delta_chi2);
}

}  // namespace armcal::agreement_test
