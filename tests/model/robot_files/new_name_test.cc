#include "model/robot_files/new_name.h"

#include <gtest/gtest.h>

namespace armcal::new_name_test {

// A link, a joint and the tool have a name each, and so has one with a line
// behind it: what is asked for gets as many as it takes.
TEST(NewName, IsNobodysYet) {
  Robot robot;
  robot.links.resize(2);
  robot.links[0].name = "base_link";
  robot.links[0].joint.name = "base_link_";
  robot.links[1].name = "arm";
  robot.links[1].joint.name = "shoulder";
  robot.tool_name = "tool";
  EXPECT_EQ(NewName(robot, "base"), "base");
  EXPECT_EQ(NewName(robot, "base_link"), "base_link__");
  EXPECT_EQ(NewName(robot, "shoulder"), "shoulder_");
  EXPECT_EQ(NewName(robot, "tool"), "tool_");
}

}  // namespace armcal::new_name_test
