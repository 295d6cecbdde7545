#include "calib/diagnose/judge/joint_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "model/signals/delayed_signal.h"
#include "tests/fixtures/diagnosed_arm.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::joint_agreement_test {

// Quantiles of chi squared: 5 degrees exceed 18.2 once in 370 times.
TEST(JointAgreementTest, JointsDifferBeyondChance) {
  EXPECT_FALSE((JointAgreement{17, 50, 5}.Differ(.2)));
  EXPECT_TRUE((JointAgreement{20, 50, 5}.Differ(.2)));
}

// What the form of a large effect has wrong differs from joint to joint.
TEST(JointAgreementTest, JointsAgreeWithinAnErrorOfForm) {
  EXPECT_FALSE((JointAgreement{20, 1000, 5}.Differ(.2)));
}

TEST(JointAgreementTest, OneJointCannotDiffer) {
  EXPECT_FALSE((JointAgreement{100, 50, 0}.Differ(.2)));
}

// Of two that move, the other would have seen a clock that is wrong.
TEST(JointAgreementTest, OneOfSeveralJointsIsNotAll) {
  EXPECT_TRUE((JointAgreement{0, 0, 0, 2, 1}.IsOfOneJoint()));
  EXPECT_FALSE((JointAgreement{0, 0, 0, 2, 2}.IsOfOneJoint()));
  EXPECT_FALSE((JointAgreement{0, 0, 0, 1, 1}.IsOfOneJoint()));
}

// Two sizes d apart scatter by tau^2 = (d^2 - v_1 - v_2) / 2, of which the mean
// of two that are equally well known has half.
TEST(JointAgreementTest, SizesThatScatterMakeTheirMeanLessCertain) {
  JointAgreement agreement;
  agreement.joints = {{0, 1, .1}, {1, 3, .1}};
  agreement.chi_squared = 2 * std::pow(1 / .1, 2);
  agreement.freedom = 1;
  EXPECT_NEAR(agreement.VarianceBetweenJoints(), (2 - .01) / 2, 1e-12);
  agreement.chi_squared = .9;  // they scatter by less than they are known to
  EXPECT_EQ(agreement.VarianceBetweenJoints(), 0);
  // The better known one tells the mean, and its size is its own.
  agreement.joints = {{0, 1, .001}, {1, 3, .1}};
  agreement.chi_squared = 4 / (.01 + 1e-6);
  EXPECT_NEAR(agreement.VarianceBetweenJoints(), (4 - .01) / 2, 1e-3);
  agreement.joints = {{0, 1, .001}};
  EXPECT_EQ(agreement.VarianceBetweenJoints(), 0);
}

// Of a few milliseconds a refit takes up all but what its prior says: it is
// seen by both joints nevertheless.
class JointAgreementOnTest : public DiagnosedArm<32> {};

TEST_F(JointAgreementOnTest, ADelayIsSeenGivenTheBaselinesOwn) {
  Add("delay", -1, {.008});
  const GapDiagnosis diagnosis = Diagnose(File());
  ASSERT_FALSE(diagnosis.effects.empty());
  EXPECT_EQ(diagnosis.effects[0].effect->name, "delay");
  ExpectEstimate(diagnosis.effects[0], "delay", .008, .1);
}

// Of two joints, with noise, that many s too late.
struct DelayedArm {
  explicit DelayedArm(double delay)
      : arm("2R planar (vertical plane)", 30, .005),
        baseline(arm.robot, {}, Eigen::VectorXd::Constant(2, 10)),
        tau(Delayed(
            RecordedTorque(arm.robot, baseline.transitions(), arm.motion)
                .nominal(),
            delay / arm.motion.dt)) {
    std::mt19937_64 random(2);
    AddNoise(&random, Eigen::VectorXd::Constant(2, .05), &tau);
  }
  EffectArm arm;
  GapBaseline baseline;
  Eigen::MatrixXd tau;
};

// Of the delay that a fit to a segment chooses first.
JointAgreement AgreementOnDelay(const GapBaseline& baseline,
                                const GapSegment& segment) {
  GapFitOptions options;
  options.bandwidth_hz = 6;
  GapFit fit(baseline, options, {segment}, {});
  fit.Choose();
  const std::vector<GapCandidate>& found = fit.refined().effects;
  if (found.empty() || found[0].effect->name != "delay") {
    ADD_FAILURE() << "no delay";
    return {};
  }
  return JointAgreementOn(fit, 0);
}

// A column is a small delay's; what a large one differs from it by is no
// disagreement of joints.
TEST(JointAgreementOn, JointsAgreeAboutALargeDelay) {
  const DelayedArm late(.05);
  const JointAgreement agreement =
      AgreementOnDelay(late.baseline, MakeSegment(late.arm.motion, late.tau));
  EXPECT_EQ(agreement.seen_by, 2);
  // 2.6e-5 by what columns leave instead of what the delay does.
  EXPECT_LT(agreement.chi_squared, 5e-6 * agreement.delta_chi2);
}

// A joint that nothing drives moves, but cannot confirm what the other one has.
TEST(JointAgreementOn, AJointWithoutTorqueConfirmsNothing) {
  DelayedArm late(.02);
  late.tau.col(1).setZero();
  GapSegment segment = MakeSegment(late.arm.motion, late.tau);
  segment.still.col(1).setConstant(true);
  const JointAgreement agreement = AgreementOnDelay(late.baseline, segment);
  EXPECT_EQ(agreement.seen_by, 1);
  EXPECT_TRUE(agreement.IsOfOneJoint());
}

// The torque of one of three joints is late by less than the others': each by
// itself says what it is late by.
TEST(JointAgreementOn, TellsWhatEachJointHas) {
  constexpr double kDelay = .03, kOther = .01;  // s
  const EffectArm arm("3R elbow", 30, .005);
  const GapBaseline baseline(arm.robot, {}, Eigen::VectorXd::Constant(3, 10));
  const Eigen::MatrixXd prompt =
      RecordedTorque(arm.robot, baseline.transitions(), arm.motion).nominal();
  Eigen::MatrixXd tau = Delayed(prompt, kDelay / arm.motion.dt);
  tau.col(1) = Delayed(prompt, kOther / arm.motion.dt).col(1);
  std::mt19937_64 random(2);
  AddNoise(&random, Eigen::Vector3d(.2, .2, .1), &tau);
  GapFitOptions options;
  options.bandwidth_hz = 6;
  for (const Effect& effect : Effects()) {
    if (effect.name != "delay") options.without.push_back(effect.name);
  }
  GapFit fit(baseline, options, {MakeSegment(arm.motion, tau)}, {});
  fit.Choose();
  ASSERT_EQ(fit.refined().effects.size(), 1u);
  const JointAgreement agreement = JointAgreementOn(fit, 0);
  ASSERT_EQ(agreement.joints.size(), 3u);
  for (const JointAgreement::JointSize& one : agreement.joints) {
    // What a log holds too late is negative.
    const double delay = one.joint == 1 ? kOther : kDelay;
    EXPECT_NEAR(one.value, -delay, .15 * kDelay) << one.joint;
    EXPECT_GT(one.stddev, 0);
  }
}

}  // namespace armcal::joint_agreement_test
