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

}  // namespace armcal::robot_variation_test
