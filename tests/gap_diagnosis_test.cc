#include "calib/gap_diagnosis.h"

#include "tests/diagnosed_arm.h"

namespace armcal {
namespace {

using GapDiagnosisTest = DiagnosedArm<32>;

TEST_F(GapDiagnosisTest, FrictionFallsWithSpeed) {
  Add("stribeck", 1, {1.2, .14});
  const GapDiagnosis diagnosis = Diagnose(File());
  ExpectFirst(diagnosis, "stribeck", 1);
  EXPECT_GT(diagnosis.torque.removed_percent, 80);
  EXPECT_EQ(diagnosis.verdict, GapVerdict::kExplained);
  ExpectEstimate(diagnosis.effects[0], "stribeck", 1.2, .1);
  ExpectEstimate(diagnosis.effects[0], "stribeck_velocity", .14, .1);
  EXPECT_EQ(diagnosis.effects.size(), 1u);
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

}  // namespace
}  // namespace armcal
