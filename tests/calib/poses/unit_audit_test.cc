// Poses in other units than their header says.

#include "calib/poses/unit_audit.h"

#include <gmock/gmock.h>

#include <cmath>

#include "calib/calibrate_parts.h"
#include "calib/diagnose_poses.h"
#include "calib/poses/diagnosis/diagnosis.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::unit_audit_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

void Scale(double angles, double lengths, PoseMeasurements* m) {
  m->q *= angles;
  for (auto& target : m->targets) target *= lengths;
  if (m->poses.size() > 0) m->poses.leftCols(3) *= lengths;
  m->lengths *= lengths;
}

TEST(UnitAudit, SaysInWhichUnitsPosesWereMeant) {
  for (const auto instrument :
       {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
    Plant plant("UR5 6R", 3);
    const PoseMeasurements right = plant.Measure(instrument, 60, kNoise);
    EXPECT_EQ(WrongUnits(plant.nominal, right), "");
    const auto told = [&](double angles, double lengths) {
      PoseMeasurements wrong = right;
      Scale(angles, lengths, &wrong);
      return WrongUnits(plant.nominal, wrong);
    };
    EXPECT_THAT(told(180 / M_PI, 1),
                AllOf(HasSubstr("[deg]"), Not(HasSubstr("[mm]"))));
    EXPECT_THAT(told(1, 1000),
                AllOf(HasSubstr("[mm]"), Not(HasSubstr("[deg]"))));
    EXPECT_THAT(told(180 / M_PI, 1000),
                AllOf(HasSubstr("'q1 [deg]'"), HasSubstr("[mm]")));
    EXPECT_THAT(told(M_PI / 180, 1), HasSubstr("without [deg]"));
    EXPECT_THAT(told(1, 1e-3), HasSubstr("without [mm]"));
  }
}

// Both files are looked at before either is used.
TEST(UnitAudit, LooksAtPosesThatWereKeptOut) {
  Plant plant("UR5 6R", 3);
  CalibrateOptions calibrate;
  DiagnosePosesOptions diagnose;
  calibrate.poses = plant.Measure(Instrument::kTargets, 30, kNoise);
  PoseMeasurements others = plant.Measure(Instrument::kTargets, 20, kNoise);
  Scale(180 / M_PI, 1, &others);
  calibrate.pose_validation = diagnose.validation = others;
  const auto refusal = [](const auto& run) -> std::string {
    try {
      run();
    } catch (const OptionError& e) {
      return e.what();
    }
    return "";
  };
  const auto says =
      AllOf(HasSubstr(OptionName("validate") + ": "), HasSubstr("'q1 [deg]'"));
  EXPECT_THAT(refusal([&] { CalibrateFromPoses(plant.nominal, calibrate); }),
              says);
  EXPECT_THAT(refusal([&] {
                DiagnosePoses(plant.nominal, *calibrate.poses, diagnose);
              }),
              says);
}

// What other units do not explain is no matter of units, and no effect either.
TEST(UnitAudit, LeavesOtherMistakesToTheVerdict) {
  Plant plant("UR5 6R", 3);
  PoseMeasurements m = plant.Measure(Instrument::kTargets, 25, kNoise);
  m.q = m.q.rowwise().reverse().eval();
  EXPECT_EQ(WrongUnits(plant.nominal, m), "");
  const PoseDiagnosis diagnosis = DiagnosePoseGap(plant.nominal, m, {});
  EXPECT_EQ(diagnosis.verdict, PoseVerdict::kNotTestable);
  EXPECT_TRUE(diagnosis.findings.empty());
  EXPECT_THAT(diagnosis.reason, HasSubstr("do not follow the joints"));
}

}  // namespace armcal::unit_audit_test
