#include "model/plant/robot_variation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_robots.h"

namespace armcal::robot_variation_test {

TEST(RobotVariation, LinksStayPhysicalAndErrorsHaveTheirSize) {
  std::mt19937_64 random(1);
  Robot robot = SampleRobot("UR5 6R");
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) link.joint.armature = 2;
  double mass = 0, lever = 0, armature = 0;
  int count = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Robot varied = VaryRobot(robot, .05, seed);
    for (int i = 0; i < 6; ++i, ++count) {
      const InertialParameters& was = robot.links[i].inertial;
      const InertialParameters& is = varied.links[i].inertial;
      EXPECT_EQ(WhyUnphysical(is), "") << seed;
      mass += std::pow(is.mass / was.mass - 1, 2);
      lever += std::pow((is.first_moment / is.mass).norm() /
                                (was.first_moment / was.mass).norm() -
                            1,
                        2);
      armature += std::pow(varied.links[i].joint.armature / 2 - 1, 2);
    }
  }
  EXPECT_NEAR(std::sqrt(mass / count), .05, .004);
  EXPECT_NEAR(std::sqrt(lever / count), .05, .004);
  EXPECT_NEAR(std::sqrt(armature / count), .05, .004);
}

TEST(RobotVariation, NoErrorChangesNothing) {
  std::mt19937_64 random(1);
  Robot robot = SampleRobot("SCARA RRPR");
  SetRandomInertials(&random, &robot);
  const Robot same = VaryRobot(robot, 0, 3);
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(same.links[i].inertial.ToVector().isApprox(
        robot.links[i].inertial.ToVector(), 1e-12));
  }
}

// The inertia of pybullet's TwoJointRobot, which breaks the triangle inequality
// by 1e-3, and a body that is far from its origin. Mass and centre stay; what
// is possible stays as it is, and what is changed is changed by no more than
// was missing.
TEST(RobotVariation, ImpossibleLinksBecomeTheNearestPossible) {
  std::mt19937_64 random(1);
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(&random, &robot);
  const Robot file = robot;
  Eigen::Matrix3d inertia;
  inertia << .00208333, .0125, .00625, .0125, .167083, .000625, .00625, .000625,
      .168333;
  const Eigen::Vector3d com(.1, 2, .3);
  robot.links[1].inertial =
      InertialParameters::FromCenterOfMass(.5, com, inertia);
  ASSERT_NE(WhyUnphysical(robot.links[1].inertial), "");
  Robot possible = robot;
  EXPECT_EQ(MakeLinksPossible(&possible),
            std::vector<std::string>{robot.links[1].name});
  const InertialParameters& is = possible.links[1].inertial;
  EXPECT_EQ(WhyUnphysical(is), "");
  EXPECT_EQ(is.mass, .5);
  EXPECT_EQ(is.first_moment, Eigen::Vector3d(.5 * com));
  EXPECT_LT((is.inertia - robot.links[1].inertial.inertia).norm(), 3e-3);
  for (const int i : {0, 2}) {
    EXPECT_EQ(possible.links[i].inertial.ToVector(),
              file.links[i].inertial.ToVector());
  }
}

}  // namespace armcal::robot_variation_test
