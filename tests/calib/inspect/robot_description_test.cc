#include "calib/inspect/robot_description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "model/robot_files/robot_reader.h"

namespace armcal::robot_description_test {

using testing::HasSubstr;

// A turning joint along y of a base that is turned by a quarter about x, and a
// sliding one along that link's x; the second link's body is not given.
const char kArm[] = R"(<robot name="arm">
  <link name="base"/> <link name="one">
    <inertial><origin xyz="0.1 0 -0.2"/><mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  </link> <link name="two"/>
  <joint name="turn" type="revolute"> <parent link="base"/> <child link="one"/>
    <origin rpy="1.5707963267948966 0 0"/> <axis xyz="0 1 0"/>
    <limit lower="-1" upper="2" velocity="3" effort="40"/>
    <dynamics damping="0.5" friction="0.25"/> </joint>
  <joint name="slide" type="prismatic"> <parent link="one"/> <child link="two"/>
    <axis xyz="1 0 0"/> </joint>
</robot>)";

Robot Arm() { return ReadRobot({"arm.urdf", kArm}, {}); }

TEST(RobotDescription, SaysWhatWasRead) {
  EXPECT_EQ(DescriptionText(Arm()),
            "  1 turn: revolute, axis 0 0 1, -1 to 2 rad, 3 rad/s, 40 N m; "
            "viscous 0.5, Coulomb 0.25\n"
            "    moves one: 2 kg, centre at 0.1 0 -0.2 m\n"
            "  2 slide: prismatic, axis 1 0 0, no position limits; no friction "
            "or armature\n"
            "    moves two: no inertia in the file\n"
            "  gravity 0 0 -9.81 m/s^2 in the base's frame\n");
}

TEST(RobotDescription, AsJson) {
  const nlohmann::json json = DescriptionJson(Arm());
  EXPECT_EQ(json["joints"][0]["name"], "turn");
  EXPECT_NEAR(json["joints"][0]["axis"][2].get<double>(), 1, 1e-15);
  EXPECT_EQ(json["joints"][0]["effort"], 40);
  EXPECT_TRUE(json["joints"][1]["upper"].is_null());
  EXPECT_EQ(json["links"][0]["mass"], 2);
  EXPECT_EQ(json["links"][0]["com"][2], -.2);
  EXPECT_TRUE(json["links"][1]["mass"].is_null());
  EXPECT_THAT(json["notes"][0].get<std::string>(),
              HasSubstr("joint 'slide' has no limits"));
}

}  // namespace armcal::robot_description_test
