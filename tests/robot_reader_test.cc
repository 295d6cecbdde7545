#include "model/robot_reader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "model/input_error.h"

namespace armcal {
namespace {

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
            "arm.urdf.xacro: expected a plain URDF: run xacro first");
  EXPECT_EQ(Refusal("arm.csv"),
            "arm.csv: found '.csv': expected a robot file that ends in .urdf "
            "or .xml (URDF) or .yaml or .yml (DH table)");
  EXPECT_EQ(Refusal("no/arm.URDF"), "no/arm.URDF: cannot be opened");
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

}  // namespace
}  // namespace armcal
