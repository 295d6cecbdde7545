#include "calib/linear/verdict.h"

#include <gmock/gmock.h>

#include "calib/linear/calibration_report.h"
#include "calib/linear/outlier_report.h"
#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::verdict_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// What is said of a 2R arm's log of 20 s of which every so many torque samples
// of the second joint are 100 times its torque.
class SpoiledArm : public testing::Test {
 protected:
  SpoiledArm() : robot_(SampleRobot("2R planar (vertical plane)")) {
    SetRandomInertials(&random_, &robot_);
    log_ = RecordMotion(RandomMultisine(&random_, 2, .5), 20, .01);
    AddTorque(robot_, &log_);
    AddNoise(&random_, .01 * ColumnRms(log_.tau), &log_.tau);
  }
  LinearCalibration Calibrate(int every) {
    Log log = log_;
    const double size = 100 * ColumnRms(log_.tau)[1];
    for (int k = every / 2; k < log.size(); k += every) log.tau(k, 1) += size;
    return CalibrateLogs(robot_, {log}, {});
  }

  std::mt19937_64 random_{21};
  Robot robot_;
  Log log_;
};

TEST_F(SpoiledArm, IsJudgedByTheSamplesThatTheFitKept) {
  const LinearCalibration result = Calibrate(50);
  EXPECT_EQ(CountOutliers(result, 1), log_.size() / 50);
  EXPECT_GT(result.training->moving().stacked_percent, 70);
  EXPECT_LT(result.training->kept().stacked_percent, 5);
  EXPECT_THAT(Shortcomings(robot_, result), IsEmpty());
  EXPECT_THAT(BriefReport(robot_, result), HasSubstr("most of it in spikes"));
  EXPECT_THAT(BriefReport(robot_, CalibrateLogs(robot_, {log_}, {})),
              Not(HasSubstr("spikes")));
}

// More than gross errors are is something that the model lacks.
TEST_F(SpoiledArm, FailsBySpikesWhereTheyAreTooMany) {
  const LinearCalibration result = Calibrate(8);
  EXPECT_THAT(Shortcomings(robot_, result), ElementsAre(HasSubstr("spikes")));
}

// Noise, of which nothing is left out.
TEST_F(SpoiledArm, FailsWhereTheTorqueIsNotOfTheMotion) {
  const Eigen::VectorXd size = ColumnRms(log_.tau);
  log_.tau.setZero();
  AddNoise(&random_, size, &log_.tau);
  EXPECT_THAT(Shortcomings(robot_, CalibrateLogs(robot_, {log_}, {})),
              ElementsAre(HasSubstr("do not belong together")));
}

}  // namespace armcal::verdict_test
