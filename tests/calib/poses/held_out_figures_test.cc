// Poses that a fit has not seen, by the estimate and by the file.

#include "calib/poses/held_out_figures.h"

#include <gmock/gmock.h>

#include <cmath>

#include "calib/poses/calibrate_poses.h"
#include "calib/poses/report.h"
#include "calib/poses/verdict.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::held_out_figures_test {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

PoseCalibration Calibrate(const Robot& robot, const PoseMeasurements& m,
                          const PoseMeasurements* validation = nullptr) {
  PoseCalibrationOptions options;
  options.loss = RobustLoss::kSquared;
  options.validation = validation;
  return CalibratePoses(robot, m, options);
}

// What both give up does not decide, however far it is away.
TEST(HeldOutFigures, AreComparedWithoutGrossErrors) {
  PoseCalibration c;
  c.solved = c.refined = true;
  c.held_out_rms = .2;  // of one pose a metre off
  c.file_held_out_rms = .19;
  c.held_out_excess.mean = -1e-5;
  EXPECT_FALSE(IsWorseThanFile(c));
  c.held_out_excess.mean = 1e-5;
  EXPECT_TRUE(IsWorseThanFile(c));
  c.file_held_out_rms = 0;  // the file's geometry was not fitted
  EXPECT_FALSE(IsWorseThanFile(c));
}

// A file that is right, and errors that are no geometry: the file's base and
// targets are fitted to the others as the estimate's are, and predict better
// than what takes 24 parameters from 12 poses.
TEST(HeldOutFigures, CompareTheFileAsItPredicts) {
  Plant plant("UR5 6R", 8);
  const PoseMeasurements m = plant.Measure(Instrument::kTargets, 12, 1e-3);
  const PoseCalibration c = Calibrate(plant.robot, m);
  ASSERT_TRUE(c.solved);
  EXPECT_GT(c.file_held_out_rms, c.before_rms);
  EXPECT_TRUE(IsWorseThanFile(c));
  EXPECT_TRUE(c.held_out_excess.is_clear());
  EXPECT_THAT(Shortcomings(plant.robot, c),
              Contains(HasSubstr("the refined geometry is worse")));
  EXPECT_THAT(PoseReport(plant.robot, m, c), StartsWith("WORSE than the file"));
}

// A little worse by chance: said, and no reason to fail.
TEST(HeldOutFigures, AreJudgedByTheirScatter) {
  Plant plant("UR5 6R", 9);
  const PoseMeasurements m = plant.Measure(Instrument::kTargets, 60, kNoise);
  PoseCalibration c = Calibrate(plant.nominal, m);
  EXPECT_FALSE(IsWorseThanFile(c));
  EXPECT_THAT(PoseReport(plant.nominal, m, c), Not(HasSubstr("WORSE")));
  EXPECT_THAT(Shortcomings(plant.nominal, c), IsEmpty());
  // What the file's prior holds has no interval of the poses.
  EXPECT_THAT(PoseReport(plant.nominal, m, c), Not(HasSubstr("(held)")));
  PoseCalibration held = c;
  held.parameters.back().prior = .02;
  held.parameters.back().stddev = 1.7;
  EXPECT_THAT(PoseReport(plant.nominal, m, held), HasSubstr("(held)"));
  // More than the file's in sample, less than it held out: not worse.
  c.held_out_rms = 4.5e-3;
  c.before_rms = 4e-3;
  c.file_held_out_rms = 5e-3;
  EXPECT_THAT(PoseNotes(plant.nominal, c), Not(Contains(HasSubstr("worse"))));
  c.compared_rms = 5.5e-3;
  c.held_out_excess.mean = 1e-6;
  c.held_out_excess.stderr_of_mean = 2e-6;
  EXPECT_THAT(PoseNotes(plant.nominal, c), Contains(HasSubstr("5.5 mm rms")));
  EXPECT_THAT(Shortcomings(plant.nominal, c), IsEmpty());
}

TEST(HeldOutFigures, AreOfPosesThatTookNoPart) {
  Plant plant("PUMA560 6R", 10);
  const PoseMeasurements m = plant.Measure(Instrument::kTargets, 60, kNoise);
  const PoseMeasurements others =
      plant.Measure(Instrument::kTargets, 40, kNoise);
  const PoseCalibration c = Calibrate(plant.nominal, m, &others);
  ASSERT_TRUE(c.validation);
  EXPECT_EQ(c.validation->count, 40);
  EXPECT_LT(c.validation->rms, 3 * kNoise);
  EXPECT_GT(c.validation->file_rms, 5e-4);
  EXPECT_THAT(PoseReport(plant.nominal, m, c),
              HasSubstr("validation 40 poses: "));
  EXPECT_EQ(PoseJson(plant.nominal, m, c)["poses"]["validation"]["count"], 40);
}

// The fixture has targets a decimetre along each axis.
TEST(HeldOutFigures, StandBesideWhereTheTargetsAre) {
  Plant plant("UR5 6R", 12);
  const PoseMeasurements m = plant.Measure(Instrument::kTargets, 60, kNoise);
  const PoseCalibration c = Calibrate(plant.robot, m);
  ASSERT_EQ(c.observed.size(), 9u);
  for (int k = 0; k < 9; ++k) {
    const ObservedEstimate& p = c.observed[k];
    EXPECT_NEAR(p.value, k / 3 == k % 3 ? .1 : 0, 4 * p.stddev) << p.name;
    EXPECT_LT(p.stddev, 1e-3);
  }
  EXPECT_EQ(c.observed[4].name, "target2.y");
  EXPECT_THAT(PoseReport(plant.robot, m, c), HasSubstr("target2.y"));
  EXPECT_EQ(PoseJson(plant.robot, m, c)["observed"].size(), 9u);
}

}  // namespace armcal::held_out_figures_test
