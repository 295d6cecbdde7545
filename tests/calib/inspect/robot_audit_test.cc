#include "calib/inspect/robot_audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::robot_audit_test {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

std::vector<std::string> Names(const Robot& robot) {
  std::vector<std::string> names;
  for (const InspectionFinding& finding : AuditRobot(robot)) {
    names.push_back(finding.finding);
  }
  return names;
}

class RobotAuditTest : public testing::Test {
 protected:
  RobotAuditTest() {
    for (Link& link : robot_.links) {
      link.joint.lower = -2;
      link.joint.upper = 2;
      link.inertial = InertialParameters::FromCenterOfMass(
          2 + .1 * static_cast<double>(&link - &robot_.links[0]),
          {.05, .02, .01}, Eigen::Vector3d(.01, .012, .015).asDiagonal());
    }
    robot_.links[1].inertial.inertia *= 1.2;
  }
  Robot robot_ = InspectedArm().robot;
};

TEST_F(RobotAuditTest, NothingIsWrong) {
  EXPECT_THAT(Names(robot_), testing::IsEmpty());
}

TEST_F(RobotAuditTest, MissingThings) {
  robot_.links[2].has_inertial = false;
  EXPECT_THAT(Names(robot_), ElementsAre("no_inertia"));
  robot_.links[2].joint.upper = std::numeric_limits<double>::infinity();
  EXPECT_THAT(Names(robot_), ElementsAre("no_inertia", "no_limits"));
}

TEST_F(RobotAuditTest, WhatCannotExist) {
  robot_.links[0].inertial.inertia(0, 0) *= 10;
  EXPECT_THAT(Names(robot_), ElementsAre("unphysical"));
}

TEST_F(RobotAuditTest, MeshesInMillimetres) {
  robot_.links[3].inertial = InertialParameters::FromCenterOfMass(
      2, {50, 20, 10}, 1e6 * Eigen::Matrix3d::Identity());
  EXPECT_THAT(Names(robot_), Contains("suspicious_inertia"));
}

// Bodies of 2 kg with k = 0.096 m, 2300 kg/m^3 by m / k^3. In g they are denser
// than osmium with the moments that they have, and with a thousand times these.
TEST_F(RobotAuditTest, MassesInGrams) {
  Robot moments_too = robot_;
  for (int j = 0; j < robot_.num_joints(); ++j) {
    InertialParameters* body = &robot_.links[j].inertial;
    const Eigen::Vector3d com = body->first_moment / body->mass;
    const Eigen::Matrix3d moments =
        Eigen::Vector3d(.01, .012, .015).asDiagonal();
    moments_too.links[j].inertial = InertialParameters::FromCenterOfMass(
        1e3 * body->mass, com, 1e3 * moments);
    *body =
        InertialParameters::FromCenterOfMass(1e3 * body->mass, com, moments);
  }
  EXPECT_THAT(Names(robot_), Contains("mass_unit"));
  EXPECT_THAT(Names(moments_too), Contains("mass_unit"));
  EXPECT_THAT(Names(moments_too), Not(Contains("suspicious_inertia")));
}

// One finding, of the file, and none of each link's inertia.
TEST_F(RobotAuditTest, LengthsInMillimetres) {
  for (Link& link : robot_.links) {
    link.X_PF.translation() *= 1e3;
    link.X_ML.translation() *= 1e3;
  }
  EXPECT_THAT(Names(robot_), ElementsAre("length_unit"));
}

TEST_F(RobotAuditTest, AnglesInDegrees) {
  const auto findings = AuditRobot(
      robot_, {"a by 90 rad", "b by 9 rad", "c by 9 rad", "d by 9 rad"});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].finding, "angle_unit");
  EXPECT_EQ(findings[0].evidence,
            "a by 90 rad, b by 9 rad, c by 9 rad and 1 more");
}

TEST_F(RobotAuditTest, Placeholders) {
  for (Link& link : robot_.links) {
    link.inertial = InertialParameters::FromCenterOfMass(
        1, Eigen::Vector3d::Zero(), .01 * Eigen::Matrix3d::Identity());
  }
  EXPECT_THAT(Names(robot_), ElementsAre("default_inertia", "default_inertia"));
}

TEST_F(RobotAuditTest, EqualLimitsOfUnlikeLinksAreNoted) {
  for (Link& link : robot_.links) {
    link.joint.velocity = 20;
    link.joint.effort = 1000;
  }
  EXPECT_THAT(RobotNotes(robot_), testing::IsEmpty());  // links are alike
  robot_.links[0].inertial.mass *= 4;
  EXPECT_THAT(RobotNotes(robot_),
              ElementsAre("every joint has the same velocity and effort limit "
                          "(20 rad/s, 1000 N m): they may be placeholders, "
                          "which armcal excite would use"));
  EXPECT_THAT(Names(robot_), testing::IsEmpty());
  robot_.links[1].joint.effort = 500;
  EXPECT_THAT(RobotNotes(robot_), testing::IsEmpty());
  robot_.links.resize(2);
  EXPECT_THAT(RobotNotes(robot_), testing::IsEmpty());
}

}  // namespace armcal::robot_audit_test
