#include "calib/diagnosed_calibration.h"

#include <gmock/gmock.h>

namespace armcal::diagnosed_calibration_test {

using testing::HasSubstr;
using testing::Not;

// The one note of a diagnosis whose calibration's own logs stand for this.
DataFinding NoteOf(GapDiagnosis::CalibrationsLogs stand) {
  CalibratedRobot calibrated;
  calibrated.converged = true;
  CalibrationLogs own;
  own.input.logs = {LogSource("monday.csv")};
  GapDiagnosis diagnosis;
  diagnosis.calibrations_logs = stand;
  NoteCalibration(calibrated, own, {}, &diagnosis);
  EXPECT_EQ(diagnosis.data.size(), 1u);
  return diagnosis.data.at(0);
}

// What the own logs have as well was judged of what is named alone. That
// nothing has changed since would be more.
TEST(NoteCalibration, SaysOfWhatIsNamedAloneThatItIsNotNew) {
  const DataFinding note = NoteOf(GapDiagnosis::CalibrationsLogs::kHaveItToo);
  EXPECT_THAT(note.finding, HasSubstr("have what is named as well "
                                      "(monday.csv)"));
  EXPECT_THAT(note.evidence, HasSubstr("that is not new"));
  EXPECT_THAT(note.evidence, HasSubstr("whether anything else has changed"));
  EXPECT_THAT(note.evidence, Not(HasSubstr("no change")));
}

TEST(NoteCalibration, SaysWhatChangesAreTold) {
  const DataFinding note =
      NoteOf(GapDiagnosis::CalibrationsLogs::kAreTheReference);
  EXPECT_EQ(note.finding,
            "the calibration's own logs are the reference (monday.csv)");
}

}  // namespace armcal::diagnosed_calibration_test
