#include "model/robot_files/sdf_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/dynamics/inverse_dynamics.h"
#include "model/robot/kinematics.h"
#include "model/robot_files/mjcf/mjcf_reader.h"
#include "model/robot_files/sdf_reader.h"
#include "tests/fixtures/two_link_arm.h"

namespace armcal::sdf_writer_test {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Contains;
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

// MuJoCo 4.0.0's mj_inverse of a body with two joints; the link between them
// was 1 kg and 1 kg m^2 for Drake, as SDF has it where a file says nothing.
TEST(MakeSdf, LinksWithoutMassHaveNone) {
  const Robot robot =
      ReadMjcf({"two.xml",
                "<mujoco><worldbody><body name='a' pos='0 0 .2'>"
                "<joint name='q1' axis='0 0 1'/>"
                "<inertial pos='0 0 .1' mass='3' diaginertia='.03 .03 .02'/>"
                "<body name='b' pos='0 0 .3'><joint name='q2' axis='0 1 0'/>"
                "<joint name='q3' axis='1 0 0'/>"
                "<inertial pos='0 0 .2' mass='2' diaginertia='.02 .02 .01'/>"
                "</body></body></worldbody></mujoco>"},
               {});
  const std::string text = MakeSdf({robot, {}});
  EXPECT_THAT(text, HasSubstr("<mass>0</mass>"));
  EXPECT_THAT(text, HasSubstr("<ixx>0</ixx>"));
  const Robot again = ReadSdf({"two.sdf", text}, {});
  const Vector3d tau = InverseDynamics(
      again, Vector3d(.3, .5, .4), Vector3d(.2, -.3, .5), Vector3d(1, -2, .7));
  EXPECT_LE((tau - Vector3d(-0.02438663082556731, -1.854456964912834,
                            -1.3084787949079018))
                .norm(),
            1e-12);
  EXPECT_THAT(SdfFormat().more_losses({robot, {}}),
              Contains(HasSubstr("have mass 0 in the file (b_q2)")));
}

}  // namespace armcal::sdf_writer_test
