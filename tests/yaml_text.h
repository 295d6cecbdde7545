#pragma once

// A DH table for tests, and what the reader makes of changes to it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "model/yaml_reader.h"
#include "tests/refusal.h"

namespace armcal {

inline const char kScara[] = R"(name: scara
gravity: [0, 0, 9.8]
convention: standard
links:
  - name: upper
    joint: revolute
    joint_name: shoulder
    a: 0.4
    alpha: 0
    mass: 5
    com: [-0.2, 0, 0]
    inertia: [0.1, 0.2, 0.3]
    limits: {lower: -1, upper: 2, velocity: 3, effort: 10}
    viscous: 0.5
    coulomb: 0.25
    armature: 0.125
    unknown: [a, d]
    zero: [hz, Ixy]
  - {joint: continuous, a: 0.3, theta: 0.25}
  - {joint: prismatic, d: 0.1, mass: 2, inertia: [1, 0.1, 2, 0.2, 0.3, 2.5]}
tool: {z: -0.05, yaw: 0.5}
)";

// Tests run beside each other.
inline std::string TempPath() {
  return testing::TempDir() + "dh" + std::to_string(getpid()) + ".yaml";
}

inline Robot Read(const std::string& text,
                  const RobotReaderOptions& options = {}) {
  const std::string path = TempPath();
  std::ofstream(path, std::ios::binary) << text;
  const Robot robot = ReadYaml(path, options);
  std::remove(path.c_str());
  return robot;
}

inline std::string Refusal(const std::string& text,
                           const RobotReaderOptions& options = {}) {
  return RefusalOf(TempPath(), text,
                   [&](const std::string& path) { ReadYaml(path, options); });
}

// Of a changed kScara.
inline std::string Refusal(const Case& c) {
  return Refusal(Changed(kScara, c));
}

}  // namespace armcal
