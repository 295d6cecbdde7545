#include "model/robot_files/sdf_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/robot/kinematics.h"
#include "model/robot_files/sdf_reader.h"
#include "tests/fixtures/two_link_arm.h"

namespace armcal::sdf_writer_test {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;

// A frame without `attached_to` moves with the model's own frame, not with what
// its pose is relative to (SDFormat specification, "Pose frame semantics"):
// Drake had the tool on the base.
TEST(MakeSdf, TheToolMovesWithTheLastLink) {
  Robot robot = TwoLinkArm().ToNamedRobot();
  robot.tool_name = "tcp";
  robot.X_LT.translation() = Vector3d(.2, .1, -.05);
  const std::string text = MakeSdf({robot, {}});
  EXPECT_THAT(text, HasSubstr("<frame name=\"tcp\" attached_to=\"" +
                              robot.links.back().name + "\">"));
  const Robot again = ReadSdf({"arm.sdf", text}, {});
  EXPECT_EQ(again.tool_name, "tcp");
  for (const Vector2d& q : {Vector2d(0, 0), Vector2d(.7, -.4)}) {
    EXPECT_LE(
        (ToolPose(again, q).matrix() - ToolPose(robot, q).matrix()).norm(),
        1e-14);
  }
}

}  // namespace armcal::sdf_writer_test
