#include "calib/inspect/torque_unit.h"

#include <gtest/gtest.h>

#include "calib/logs/uniform_series.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::torque_unit_test {

std::vector<InspectionFinding> Find(const Robot& robot, const Log& log) {
  const WiringSamples samples = UniformSeries(log, .01, .05, 8).Pick(400, 0);
  return FindTorqueUnits(robot, samples, TorqueScale(robot, samples));
}

void Scale(double factor, Link* link) {
  link->inertial =
      InertialParameters::FromVector(factor * link->inertial.ToVector());
}

TEST(TorqueUnit, NothingIsSaidOfNewtonMetres) {
  const InspectedArm arm;
  EXPECT_TRUE(Find(arm.robot, arm.log).empty());
  // Nor where the file's masses are three times too small, or too large.
  for (const double wrong : {1 / 3., 3.}) {
    Robot robot = arm.robot;
    for (Link& link : robot.links) Scale(wrong, &link);
    EXPECT_TRUE(Find(robot, arm.log).empty());
  }
}

TEST(TorqueUnit, OfAllJointsIsNamed) {
  const InspectedArm arm;
  const struct {
    double factor;
    const char *finding, *sentence;
  } kCases[] = {
      {1000, "torque_unit", "the torques are in mN m or N mm, not in N m"},
      {.001, "torque_unit", "the torques are in kN m, not in N m"},
      {50, "torque_unit", "the torques are in another unit than N m"},
      {.02, "torque_is_current",
       "the torques are motor currents, or of the motors' side of gears"}};
  for (const auto& c : kCases) {
    Log log = arm.log;
    log.tau *= c.factor;
    const auto findings = Find(arm.robot, log);
    ASSERT_EQ(findings.size(), 1u) << c.factor;
    EXPECT_EQ(findings[0].finding, c.finding);
    EXPECT_EQ(findings[0].sentence, c.sentence);
    EXPECT_EQ(findings[0].joint, -1);
  }
}

// Each by its own constant: no unit that all share.
TEST(TorqueUnit, CurrentsAreTold) {
  InspectedArm arm;
  const double constants[] = {15, 13, 11, 8, 40, 20};
  for (int j = 0; j < 6; ++j) arm.log.tau.col(j) /= constants[j];
  const auto findings = Find(arm.robot, arm.log);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].finding, "torque_is_current");
}

// One joint's links may be a few times as heavy as the file has them, too.
TEST(TorqueUnit, CurrentsAreToldThoughOneJointHidesIt) {
  InspectedArm arm;
  const double constants[] = {15, 13, 11, 8, 2, 20};
  for (int j = 0; j < 6; ++j) arm.log.tau.col(j) /= constants[j];
  auto findings = Find(arm.robot, arm.log);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].finding, "torque_is_current");
  EXPECT_EQ(findings[0].joint, -1);
  // On the other side of 1 it is no current.
  arm.log.tau.col(4) *= 4;
  for (const InspectionFinding& finding : Find(arm.robot, arm.log)) {
    EXPECT_GE(finding.joint, 0);
  }
}

TEST(TorqueUnit, OfOneJointIsNamedWithItsJoint) {
  const InspectedArm arm;
  for (const int j : {1, 2}) {
    for (const double factor : {1000., 20., .05}) {
      Log log = arm.log;
      log.tau.col(j) *= factor;
      const auto findings = Find(arm.robot, log);
      ASSERT_EQ(findings.size(), 1u) << j << ", " << factor;
      EXPECT_EQ(findings[0].joint, j);
      EXPECT_EQ(findings[0].finding,
                factor > 1 ? "torque_unit" : "torque_is_current");
      EXPECT_LT(findings[0].held_out_after, .8 * findings[0].held_out_before);
    }
  }
}

// What the last link carries is no unit, however heavy: the other joints carry
// it, too.
TEST(TorqueUnit, APayloadIsNoUnit) {
  const InspectedArm arm;
  Robot light = arm.robot;
  Scale(.05, &light.links[5]);
  const auto findings = Find(light, arm.log);
  EXPECT_TRUE(findings.empty())
      << findings[0].sentence << " " << findings[0].evidence;
  // Though the scales of the joints that carry it alone are far from 1.
  const WiringSamples samples =
      UniformSeries(arm.log, .01, .05, 8).Pick(400, 0);
  EXPECT_GT(TorqueScale(light, samples).scale.maxCoeff(), 4);
}

}  // namespace armcal::torque_unit_test
