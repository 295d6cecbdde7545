#include "calib/force_torque/change.h"

#include <gmock/gmock.h>

#include "tests/calib/force_torque/carried_tool.h"

namespace armcal::change_test {

using testing::HasSubstr;

Log Carry(const Robot& robot, const CarriedTool& tool,
          std::mt19937_64* random) {
  Log log = RecordMotion(RandomMultisine(random, 6), 20, .004);
  AddWrench(robot, tool, random, &log);
  return log;
}

// 0.4 kg more by Simbody, a sensor that was set to zero in between, and two
// touches of half a second and a second, whose ends the low pass at 10 Hz
// spreads by a tenth or so.
TEST(ForceTorqueChange, TellsMassAndContacts) {
  std::mt19937_64 random(5);
  const Robot robot = SampleRobot("UR5 6R");
  CarriedTool tool = CarriedTool::Random(&random);
  const std::vector<ForceTorqueSample> before =
      SamplesOf(robot, Carry(robot, tool, &random));
  tool.truth.mass += .4;
  tool.truth.bias.setZero();
  Log log = Carry(robot, tool, &random);
  log.wrench.middleRows(1000, 125).col(0).array() += 12;  // 4 to 4.5 s
  log.wrench.middleRows(3000, 250).col(2).array() -= 25;  // 12 to 13 s
  const ForceTorqueChange change =
      CompareForceTorque(before, SamplesOf(robot, log));
  ASSERT_TRUE(change.is_told());
  EXPECT_NEAR(change.mass, .4, 2.5 * change.mass_stddev);
  EXPECT_LT(change.mass_stddev, .01);
  ASSERT_EQ(change.contacts.size(), 2u);
  EXPECT_NEAR(change.contacts[0].begin, 4, .15);
  EXPECT_NEAR(change.contacts[0].end, 4.5, .15);
  EXPECT_NEAR(change.contacts[0].force, 12, 2);
  EXPECT_NEAR(change.contacts[1].begin, 12, .15);
  EXPECT_NEAR(change.contacts[1].end, 13, .15);
  EXPECT_NEAR(change.contacts[1].force, 25, 4);  // the low pass overshoots
  const nlohmann::json json = ForceTorqueJson(change, {"log.csv"});
  EXPECT_EQ(json["contacts"][1]["log"], "log.csv");
  EXPECT_LT(json["ci95"][0], json["mass_change"]);
  EXPECT_THAT(ForceTorqueText(change), HasSubstr("in 2 stretches"));
}

// Nothing touches ten robots that carry as much as before; an interval of 95 %
// misses the truth in more than two of ten once in 87 times.
TEST(ForceTorqueChange, IsQuietWhereNothingChanged) {
  int held = 0;
  for (int run = 0; run < 10; ++run) {
    std::mt19937_64 random(run);
    const Robot robot = SampleRobot("UR5 6R");
    const CarriedTool tool = CarriedTool::Random(&random);
    const auto before = SamplesOf(robot, Carry(robot, tool, &random));
    const auto now = SamplesOf(robot, Carry(robot, tool, &random));
    const ForceTorqueChange change = CompareForceTorque(before, now);
    EXPECT_TRUE(change.contacts.empty()) << run;
    held += std::abs(change.mass) < 1.96 * change.mass_stddev;
  }
  EXPECT_GE(held, 8);
}

// One orientation before: says so, and claims nothing.
TEST(ForceTorqueChange, AReferenceOfOneOrientationTellsNothing) {
  std::mt19937_64 random(1);
  const Robot robot = SampleRobot("UR5 6R");
  const CarriedTool tool = CarriedTool::Random(&random);
  Log still = RecordMotion(RandomMultisine(&random, 6), 5, .004);
  still.q.rowwise() = Eigen::RowVectorXd(still.q.row(0));
  still.qd.setZero();
  still.qdd.setZero();
  AddWrench(robot, tool, &random, &still);
  const ForceTorqueChange change = CompareForceTorque(
      SamplesOf(robot, still), SamplesOf(robot, Carry(robot, tool, &random)));
  EXPECT_FALSE(change.is_told());
  EXPECT_TRUE(change.contacts.empty());
  EXPECT_TRUE(ForceTorqueJson(change, {"log"})["mass_change"].is_null());
  EXPECT_THAT(ForceTorqueText(change), HasSubstr("the reference cannot tell"));
}

}  // namespace armcal::change_test
