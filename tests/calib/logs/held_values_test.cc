#include "calib/logs/held_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::held_values_test {

using testing::ElementsAre;
using testing::IsEmpty;

class HeldValuesTest : public testing::Test {
 protected:
  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const InspectionFinding& f : AuditHeldValues(arm_.robot, arm_.log)) {
      names.push_back(f.finding + "@" + std::to_string(f.joint + 1));
    }
    return names;
  }

  InspectedArm arm_{"2R planar (vertical plane)", 20};
};

TEST_F(HeldValuesTest, NothingIsHeld) { EXPECT_THAT(Names(), IsEmpty()); }

TEST_F(HeldValuesTest, RowsThatRepeatTheRowBefore) {
  Log& log = arm_.log;
  for (int k = 5; k < log.size(); k += 5) {
    log.q.row(k) = log.q.row(k - 1);
    log.qd.row(k) = log.qd.row(k - 1);
    log.tau.row(k) = log.tau.row(k - 1);
  }
  EXPECT_THAT(Names(), ElementsAre("repeated_rows@0"));
}

TEST_F(HeldValuesTest, ATorqueThatIsHeld) {
  for (int k = 0; k < arm_.log.size(); ++k) {
    arm_.log.tau(k, 1) = arm_.log.tau(k - k % 4, 1);
  }
  EXPECT_THAT(Names(), ElementsAre("held@2"));
}

// A controller ten times slower than the log; what holds its torque as long
// while the joint rests holds nothing back.
TEST_F(HeldValuesTest, ATorqueThatIsHeldForLong) {
  const Eigen::MatrixXd tau = arm_.log.tau;
  for (int k = 0; k < arm_.log.size(); ++k) {
    arm_.log.tau(k, 1) = tau(k - k % 12, 1);
  }
  EXPECT_THAT(Names(), ElementsAre("held@2"));
  arm_.log.q.col(1).setConstant(.3);
  EXPECT_THAT(Names(), IsEmpty());
}

// What is rounded to few digits repeats itself as it should, at rest too.
TEST_F(HeldValuesTest, CoarseValuesAreNotHeld) {
  const auto round = [](double step, Eigen::MatrixXd* x) {
    *x = step * (*x / step).array().round();
  };
  const double rms = ColumnRms(arm_.log.tau)[1];
  round(.05 * rms, &arm_.log.tau);
  round(.005, &arm_.log.q);
  round(.05, &arm_.log.qd);
  arm_.log.q.col(0).head(500).setConstant(arm_.log.q(500, 0));
  EXPECT_THAT(Names(), IsEmpty());
}

}  // namespace armcal::held_values_test
