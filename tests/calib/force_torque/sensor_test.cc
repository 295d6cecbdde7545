#include "calib/force_torque/sensor.h"

#include <gmock/gmock.h>

#include "calib/force_torque/report.h"
#include "tests/calib/force_torque/carried_tool.h"

namespace armcal::sensor_test {

using Model = ForceTorqueModel;
using testing::HasSubstr;

constexpr double kDuration = 20, kStep = .004;  // s

Log Move(const Multisine& motion, const Robot& robot, const CarriedTool& tool,
         std::mt19937_64* random) {
  Log log = RecordMotion(motion, kDuration, kStep);
  AddWrench(robot, tool, random, &log);
  return log;
}

// Simbody's wrenches of random tools, mounted and biased at random; every other
// one with noise that is correlated over 50 ms. An interval of 95 % holds the
// truth in 38 of 40.
TEST(ForceTorqueSensor, IntervalsHoldTheTruth) {
  constexpr int kRuns = 40;
  const Robot robot = SampleRobot("UR5 6R");
  Eigen::Matrix<int, Model::kUnknowns, 1> held;
  held.setZero();
  int of_load = 0;
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937_64 random(run);
    CarriedTool tool = CarriedTool::Random(&random);
    tool.truth.sign = run % 4 == 3 ? -1 : 1;
    tool.correlation = run % 2 == 1 ? std::exp(-kStep / .05) : 0;
    const ForceTorqueSensor sensor = EstimateForceTorqueSensor(SamplesOf(
        robot, Move(RandomMultisine(&random, 6), robot, tool, &random)));
    ASSERT_TRUE(sensor.solved) << run;
    EXPECT_GE(sensor.directions, 2) << run;
    EXPECT_EQ(sensor.fit.model.sign, tool.truth.sign) << run;
    of_load += sensor.fit.model.sign < 0;
    const Model::Unknowns error = ErrorsOf(sensor.fit.model, tool.truth);
    for (int k = 0; k < Model::kUnknowns; ++k) {
      held[k] += std::abs(error[k]) < 1.96 * sensor.Stddev(k);
    }
    EXPECT_LT(sensor.Stddev(Model::kMass), .01) << run;
    EXPECT_LT(sensor.Stddev(Model::kRotation), .01) << run;
  }
  EXPECT_EQ(of_load, kRuns / 4);
  // Of all 760 intervals 95 % are expected, and at least 38 - 3 * 1.4 of 40.
  EXPECT_GE(held.sum(), .92 * kRuns * Model::kUnknowns);
  for (int k = 0; k < Model::kUnknowns; ++k) {
    EXPECT_GE(held[k], 34) << "unknown " << k;
  }
  RecordProperty("held_of_760", held.sum());
}

// What touches the tool for a twentieth of the time changes nothing that an
// interval would not hold.
TEST(ForceTorqueSensor, ContactsDoNotPull) {
  std::mt19937_64 random(2);
  const Robot robot = SampleRobot("UR5 6R");
  const CarriedTool tool = CarriedTool::Random(&random);
  Log log = Move(RandomMultisine(&random, 6), robot, tool, &random);
  log.wrench.middleRows(2000, 250).col(2).array() += 30;
  const ForceTorqueSensor sensor =
      EstimateForceTorqueSensor(SamplesOf(robot, log));
  ASSERT_TRUE(sensor.solved);
  const Model::Unknowns error = ErrorsOf(sensor.fit.model, tool.truth);
  for (int k = 0; k < Model::kUnknowns; ++k) {
    EXPECT_LT(std::abs(error[k]), 3.5 * sensor.Stddev(k)) << k;
  }
}

// A joint about the vertical axis leaves gravity where it is in the sensor's
// axes.
TEST(ForceTorqueSensor, OneOrientationTellsNoBias) {
  std::mt19937_64 random(1);
  const Robot robot = SampleRobot("UR5 6R");
  const CarriedTool tool = CarriedTool::Random(&random);
  Multisine motion = RandomMultisine(&random, 6);
  motion.amplitude.bottomRows(5).setZero();
  motion.omega *= .1;
  const ForceTorqueSensor sensor = EstimateForceTorqueSensor(
      SamplesOf(robot, Move(motion, robot, tool, &random)));
  EXPECT_GT(sensor.samples, 500);
  EXPECT_FALSE(sensor.solved);
  EXPECT_LT(sensor.directions, 2);
  EXPECT_THAT(ForceTorqueText(sensor),
              HasSubstr("cannot tell mass, centre of mass, rotation and bias"));
  const nlohmann::json json = ForceTorqueJson(sensor);
  EXPECT_FALSE(json.contains("bias"));
  EXPECT_FALSE(json["solved"]);
}

// Gravity that turns in one plane leaves two mountings; what the turning of a
// load off the axis needs would tell them apart.
TEST(ForceTorqueSensor, OnePlaneTellsNoSign) {
  std::mt19937_64 random(3);
  const Robot robot = SampleRobot("2R planar (vertical plane)");
  CarriedTool tool = CarriedTool::Random(&random);
  tool.truth.center << 0, 0, .08;  // on the last joint's axis
  tool.noise << 2, 2, 2, .1, .1, .1;
  Multisine motion = RandomMultisine(&random, 2);
  motion.omega *= .2;
  const ForceTorqueSensor sensor = EstimateForceTorqueSensor(
      SamplesOf(robot, Move(motion, robot, tool, &random)));
  ASSERT_TRUE(sensor.solved);
  EXPECT_EQ(sensor.directions, 2);
  EXPECT_EQ(sensor.fit.model.sign, 1);
  EXPECT_THAT(ForceTorqueText(sensor), HasSubstr("whether the sensor reports"));
  EXPECT_NEAR(sensor.fit.model.mass, tool.truth.mass,
              3.5 * sensor.Stddev(Model::kMass));
  // A slow motion shows little of an inertia, and in a plane at most one entry.
  EXPECT_FALSE(sensor.inertia_told[0]);
  EXPECT_TRUE(ForceTorqueJson(sensor)["inertia"]["Ixx"].is_null());
}

TEST(ForceTorqueSensor, LogsWithoutTheColumnsTellNothing) {
  std::mt19937_64 random(1);
  const Robot robot = SampleRobot("UR5 6R");
  const Log log = RecordMotion(RandomMultisine(&random, 6), 5, kStep);
  const auto samples = SamplesOf(robot, log);
  EXPECT_TRUE(samples.empty());
  EXPECT_EQ(ForceTorqueText(EstimateForceTorqueSensor(samples)), "");
}

}  // namespace armcal::sensor_test
