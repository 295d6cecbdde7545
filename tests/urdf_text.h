#pragma once

// URDF texts for tests, and what ReadUrdf makes of them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "model/urdf_reader.h"
#include "tests/refusal.h"

namespace armcal {

// Tests run beside each other.
inline std::string TempPath() {
  return testing::TempDir() + "arm" + std::to_string(getpid()) + ".urdf";
}

inline Robot Read(const std::string& elements,
                  const RobotReaderOptions& options = {}) {
  const std::string path = TempPath();
  std::ofstream(path) << "<robot name='arm'>" << elements << "</robot>";
  const Robot robot = ReadUrdf(path, options);
  std::remove(path.c_str());
  return robot;
}

inline std::string LinkXml(const std::string& name,
                           const std::string& inner = "") {
  return "<link name='" + name + "'>" + inner + "</link>";
}

inline std::string JointXml(const std::string& name, const std::string& type,
                            const std::string& parent, const std::string& child,
                            const std::string& inner = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" +
         parent + "'/><child link='" + child + "'/>" + inner + "</joint>";
}

inline std::string Inertial(const std::string& origin, const std::string& mass,
                            const std::string& xx, const std::string& yy,
                            const std::string& zz) {
  return "<inertial><origin " + origin + "/><mass value='" + mass +
         "'/><inertia ixx='" + xx + "' ixy='0' ixz='0' iyy='" + yy +
         "' iyz='0' izz='" + zz + "'/></inertial>";
}

inline const char kArm[] = R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0.1 0 0" rpy="0 0 0"/>
      <mass value="2"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/>
    <child link="upper"/>
    <origin xyz="0 0 0.5" rpy="0 0 0"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" effort="10" velocity="3"/>
    <dynamics damping="0.5" friction="0.25"/>
  </joint>
  <link name="fore"/>
  <joint name="elbow" type="continuous">
    <parent link="upper"/>
    <child link="fore"/>
    <origin xyz="0.4 0 0"/>
    <axis xyz="0 0 1"/>
  </joint>
</robot>
)";

inline std::string Refusal(const std::string& text,
                           const RobotReaderOptions& options = {}) {
  return RefusalOf(TempPath(), text,
                   [&](const std::string& path) { ReadUrdf(path, options); });
}

// Of a changed kArm.
inline std::string Refusal(const Case& c) { return Refusal(Changed(kArm, c)); }

}  // namespace armcal
