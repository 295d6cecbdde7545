#include "calib/diagnose/diagnosis.h"

#include <cmath>

#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::diagnosis_test {

using GapDiagnosisTest = DiagnosedArm<32>;

// What is drawn is what the figures are of, and the fitted effect is its law.
void ExpectTraceOf(const GapDiagnosis& diagnosis, double stribeck,
                   double velocity) {
  ASSERT_EQ(diagnosis.traces.size(), 1u);
  const BinnedProfile& over = diagnosis.traces[0].where[1].velocity;
  Eigen::Vector3d squares(0, 0, 0);
  double samples = 0;
  for (int k = 0; k < over.size(); ++k) {
    if (over.samples(k) == 0) continue;
    const double here = static_cast<double>(over.samples(k));
    squares += here * over.Rms(k).cwiseAbs2();
    samples += here;
    const double v = over.begin() + (k + .5) * over.width();
    // Next to a reversal the low pass averages over both signs.
    if (std::abs(v) < .1 || std::abs(v) > 1 || here < 5) continue;
    const double law = stribeck * std::exp(-std::pow(v / velocity, 2));
    const Eigen::Vector3d mean = over.Mean(k);
    EXPECT_NEAR(mean[0] - mean[2], std::copysign(law, v), .25 * stribeck) << v;
  }
  const Eigen::Vector3d rms = (squares / samples).cwiseSqrt();
  const JointGap& joint = diagnosis.joints[1];
  EXPECT_NEAR(rms[0], joint.nominal_rms, .2 * joint.nominal_rms);
  EXPECT_NEAR(rms[1], joint.refit_rms, .2 * joint.refit_rms);
  EXPECT_NEAR(rms[2], joint.after_rms, .2 * joint.after_rms);
}

TEST_F(GapDiagnosisTest, FrictionFallsWithSpeed) {
  Add("stribeck", 1, {1.2, .14});
  const GapDiagnosis diagnosis = Diagnose(File());
  ExpectFirst(diagnosis, "stribeck", 1);
  EXPECT_GT(diagnosis.torque.removed_percent, 80);
  EXPECT_EQ(diagnosis.verdict, GapVerdict::kExplained);
  ExpectEstimate(diagnosis.effects[0], "stribeck", 1.2, .1);
  ExpectEstimate(diagnosis.effects[0], "stribeck_velocity", .14, .1);
  EXPECT_EQ(diagnosis.effects.size(), 1u);
  ExpectTraceOf(diagnosis, 1.2, .14);
}

// It goes on, and the next log starts at another point of its swing.
TEST_F(GapDiagnosisTest, AVibrationHasAnotherPhaseInAnotherLog) {
  later_ = truth_;
  Add("vibration", 0, {2, 0, 3.3});
  AddTo("vibration", 0, {-1, 1.7, 3.3}, &*later_);
  const GapDiagnosis diagnosis = Diagnose(File());
  ExpectFirst(diagnosis, "vibration", 0);
  EXPECT_GT(diagnosis.torque.removed_percent, 80);
}

TEST_F(GapDiagnosisTest, APayloadSinceTheReference) {
  const Effect& payload = *FindEffect("payload");
  std::vector<double> p(payload.parameters.size(), 0);
  p[0] = .6;  // kg
  Add("payload", -1, p);
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  ExpectFirst(diagnosis, "payload", -1);
  EXPECT_GT(diagnosis.torque.removed_percent, 80);
  EXPECT_EQ(diagnosis.floor, NoiseFloor::kReference);
  ExpectEstimate(diagnosis.effects[0], "mass", .6, .02);
}

// What is far from in proportion in it looks like a heavier link beside it, as
// long as columns are those of a small one. Parts of the log choose by such
// columns, would take the link, and confirm nothing: it is not as sure.
TEST_F(GapDiagnosisTest, AnOffsetOfManyDegreesIsOneEffect) {
  Add("encoder_offset", 1, {-.3});
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  ExpectFirst(diagnosis, "encoder_offset", 1, .7);
  ExpectEstimate(diagnosis.effects[0], "offset", -.3, .01);
  EXPECT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.candidates.size(), 1u);
}

// A swing that is in one log only was no law: it is told, and all that is shown
// is of what is claimed.
TEST_F(GapDiagnosisTest, WhatIsNotClaimedIsInNoFigure) {
  Add("stribeck", 1, {1.2, .14});
  later_ = truth_;
  Add("vibration", 0, {.3, 0, 3.3});
  const GapDiagnosis diagnosis = Diagnose(File());
  ExpectFirst(diagnosis, "stribeck", 1);
  EXPECT_EQ(diagnosis.effects.size(), 1u);
  ASSERT_EQ(diagnosis.unnamed.size(), 1u);
  EXPECT_EQ(diagnosis.unnamed[0].effect->name, "vibration");
  // With it, the mean square would be off by 50 times the noise's.
  EXPECT_LT(diagnosis.torque.after, 3);
  EXPECT_LT(diagnosis.joints[0].after_rms, 1.2 * kNoise);
  const FoundEffect& claimed = diagnosis.effects[0];
  EXPECT_EQ(claimed.removed_percent, diagnosis.torque.removed_percent);
  ExpectEstimate(claimed, "stribeck", 1.2, .1);
}

}  // namespace armcal::diagnosis_test
