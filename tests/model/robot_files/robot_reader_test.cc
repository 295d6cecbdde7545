#include "model/robot_files/robot_reader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "model/text/input_error.h"

namespace armcal::robot_reader_test {

std::string Refusal(const std::string& path) {
  try {
    ReadRobot(path, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RobotReader, GoesByTheEnding) {
  EXPECT_EQ(Refusal("arm.urdf.xacro"),
            "arm.urdf.xacro: expected a plain URDF: run xacro first (xacro "
            "robot.urdf.xacro > robot.urdf)");
  EXPECT_EQ(Refusal("arm.csv"),
            "arm.csv: found '.csv': expected a robot file that ends in .urdf, "
            ".xml, .mjcf or .sdf (URDF, MJCF or SDF) or .yaml or .yml (DH "
            "table or poses)");
  EXPECT_EQ(Refusal("no/arm.URDF"),
            "no/arm.URDF: cannot be opened: No such file or directory");
}

// The root element tells URDF from MJCF, whatever the file is called.
TEST(RobotReader, LooksIntoXml) {
  const char kBody[] =
      "<mujoco model='m'><worldbody><body><joint/><inertial pos='0 0 0' "
      "mass='1' diaginertia='1 1 1'/></body></worldbody></mujoco>";
  const char kLinks[] =
      "<robot name='u'><link name='a'/><link name='b'/><joint name='j' "
      "type='continuous'><parent link='a'/><child link='b'/></joint></robot>";
  for (const char* ending : {".urdf", ".xml", ".mjcf"}) {
    const std::string path =
        testing::TempDir() + "robot" + std::to_string(getpid()) + ending;
    std::ofstream(path) << kBody;
    EXPECT_EQ(KindOfRobotFile(path), RobotFileKind::kMjcf);
    EXPECT_EQ(ReadRobot(path, {}).name, "m");
    std::ofstream(path) << kLinks;
    EXPECT_EQ(KindOfRobotFile(path), RobotFileKind::kUrdf);
    EXPECT_EQ(ReadRobot(path, {}).name, "u");
    std::ofstream(path) << "<sdf/>";
    EXPECT_EQ(KindOfRobotFile(path), RobotFileKind::kSdf);
    std::ofstream(path) << "<world/>";
    EXPECT_EQ(Refusal(path), path +
                                 ": line 1, <world>: found 'world': expected "
                                 "the root element <robot> (URDF), <mujoco> "
                                 "(MJCF) or <sdf>");
    std::remove(path.c_str());
  }
}

TEST(RobotReader, RefusesNumbersWhoseProductsOverflow) {
  const std::string path =
      testing::TempDir() + "robot" + std::to_string(getpid()) + ".yaml";
  const auto refusal = [&](const std::string& com) {
    std::ofstream(path) << "convention: standard\nlinks: [{joint: revolute, "
                        << "mass: 1, com: [" << com << ", 0, 0]}]\n";
    const std::string message = Refusal(path);
    std::remove(path.c_str());
    return message;
  };
  EXPECT_EQ(refusal("1e100"), "");
  EXPECT_EQ(refusal("1e200"), path +
                                  ": the numbers of link 'link1' are too "
                                  "large to calculate with");
}

}  // namespace armcal::robot_reader_test
