#include "calib/diagnose/since_calibration.h"

#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::since_calibration_test {

using Stand = GapDiagnosis::CalibrationsLogs;

// A calibrated arm with the log that it was calibrated on (of `before_`), and
// another one.
class SinceCalibrationTest : public DiagnosedArm<32> {
 protected:
  GapDiagnosis Diagnosed() {
    LogReaderOptions reader;
    reader.joint_names = File().JointNames();
    const LogSet training({Record(truth_, "after.csv")}, reader, {});
    const LogSet own({Record(before_, "own.csv")}, reader, {});
    DiagnosisOptions options;
    options.bandwidth_hz = 6;
    options.forward = false;
    return DiagnoseSinceCalibration(File(), options, .5, training, nullptr,
                                    own);
  }
};

TEST_F(SinceCalibrationTest, WhatItsOwnLogsHaveIsWhatItLacks) {
  AddAlways("stribeck", 1, {1.2, .14});
  const GapDiagnosis diagnosis = Diagnosed();
  ExpectFirst(diagnosis, "stribeck", 1);
  ExpectEstimate(diagnosis.effects[0], "stribeck", 1.2, .1);
  EXPECT_EQ(diagnosis.calibrations_logs, Stand::kHaveItToo);
  EXPECT_FALSE(diagnosis.has_reference);
}

TEST_F(SinceCalibrationTest, WhatTheyDoNotHaveHasChanged) {
  std::vector<double> p(FindEffect("payload")->parameters.size(), 0);
  p[0] = .6;  // kg
  Add("payload", -1, p);
  const GapDiagnosis diagnosis = Diagnosed();
  ExpectFirst(diagnosis, "payload", -1);
  ExpectEstimate(diagnosis.effects[0], "mass", .6, .02);
  EXPECT_EQ(diagnosis.calibrations_logs, Stand::kAreTheReference);
  EXPECT_TRUE(diagnosis.has_reference && diagnosis.has_calibration);
}

// Both at once: what they have as well is told apart from what has changed.
TEST_F(SinceCalibrationTest, WhatTheyHaveIsNoChangeBesideOne) {
  AddAlways("stribeck", 1, {1.2, .14});
  Add("torque_gain", 0, {.1});
  const GapDiagnosis diagnosis = Diagnosed();
  ASSERT_FALSE(diagnosis.effects.empty());
  EXPECT_EQ(diagnosis.effects[0].effect->name, "torque_gain");
  EXPECT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.calibrations_logs, Stand::kAreTheReference);
}

TEST_F(SinceCalibrationTest, WhereNothingIsMissingNothingIsNamed) {
  const GapDiagnosis diagnosis = Diagnosed();
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_EQ(diagnosis.verdict, GapVerdict::kNoiseFloor);
}

// Two of which one is there are a change, though neither is named.
TEST(TellsOfAChange, WhereOneOfAFewIsThere) {
  GapDiagnosis changed;
  EXPECT_FALSE(TellsOfAChange(changed));
  changed.unnamed.emplace_back();
  EXPECT_FALSE(TellsOfAChange(changed));
  changed.unnamed.back().one_of_few = true;
  EXPECT_TRUE(TellsOfAChange(changed));
  changed.unnamed.clear();
  changed.effects.emplace_back();
  EXPECT_TRUE(TellsOfAChange(changed));
}

}  // namespace armcal::since_calibration_test
