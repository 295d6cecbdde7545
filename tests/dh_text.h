#pragma once

// A DH table for tests, and what the reader makes of changes to it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "model/dh_reader.h"
#include "model/input_error.h"

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

inline std::string WriteTemp(const std::string& text) {
  const std::string path =
      testing::TempDir() + "dh" + std::to_string(getpid()) + ".yaml";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

inline Robot Read(const std::string& text,
                  const RobotReaderOptions& options = {}) {
  const std::string path = WriteTemp(text);
  const Robot robot = ReadDhTable(path, options);
  std::remove(path.c_str());
  return robot;
}

// What the reader says about `text`, without the file's name.
inline std::string Refusal(const std::string& text,
                           const RobotReaderOptions& options = {}) {
  const std::string path = WriteTemp(text);
  std::string message;
  try {
    ReadDhTable(path, options);
  } catch (const InputError& error) {
    message = error.what();
    EXPECT_EQ(message.rfind(path + ": ", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    message.erase(0, path.size() + 2);
  }
  std::remove(path.c_str());
  return message;
}

// A change of kScara and what is then refused.
struct Case {
  const char* old_text;  // in kScara, the first such
  const char* new_text;
  const char* message;
};

inline std::string Refusal(const Case& c) {
  std::string text = kScara;
  const size_t at = text.find(c.old_text);
  EXPECT_NE(at, std::string::npos) << c.old_text;
  return Refusal(text.replace(at, std::string(c.old_text).size(), c.new_text));
}

}  // namespace armcal
