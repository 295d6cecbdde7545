#include "calib/poses/diagnosis/report.h"

#include <gmock/gmock.h>

#include "tests/fixtures/hidden_poses.h"

namespace armcal::pose_report_test {

using testing::HasSubstr;
using testing::Not;

// The first sentence has the distance of every sixth pose; that a stretch of
// the order is not predicted has to stand beside it.
TEST(PoseDiagnosisReport, SaysWhereAStretchIsNotPredicted) {
  const HiddenPoses arm("UR5 6R", Instrument::kTargets, 1, 50, 14);
  const PoseMeasurements measured = arm.Measure({}, kNoise, 6);
  PoseDiagnosis diagnosis = DiagnosePoseGap(arm.nominal(), measured, {});
  const std::string told = "a stretch of poses is not predicted by the others";
  EXPECT_THAT(PoseDiagnosisReport(arm.nominal(), measured, diagnosis),
              Not(HasSubstr(told)));
  diagnosis.gap.stretches_after = .358;
  EXPECT_THAT(PoseDiagnosisReport(arm.nominal(), measured, diagnosis),
              HasSubstr(told + " (358 mm)"));
}

}  // namespace armcal::pose_report_test
