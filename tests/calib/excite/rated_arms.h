#pragma once

#include <random>
#include <string>
#include <vector>

#include "model/robot_files/robot_reader.h"
#include "tests/blind/blind_arms.h"
#include "tests/fixtures/temp_file.h"

namespace armcal {

// What a maker allows a joint: rad or m, rad/s or m/s, N m or N.
struct Rating {
  double lower, upper, velocity, effort;
};

// Arms of the blind bench with limits as their makers give them: "scara" (of
// the size of an Adept One), "puma" (ranges of the Unimate PUMA 560, torques of
// Corke and Armstrong-Helouvry 1994), "ur5" (Universal Robots), "panda"
// (Franka Control Interface).
inline Robot RatedArm(const std::string& name) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const auto turning = [](double low, double high, double speed,
                          double torque) -> Rating {
    return {low * kDegree, high * kDegree, speed * kDegree, torque};
  };
  std::vector<Rating> ratings;
  if (name == "scara") {
    ratings = {turning(-150, 150, 540, 150),
               turning(-147, 147, 540, 60),
               {-.0975, .0975, .5, 120},
               turning(-180, 180, 720, 5)};
  } else if (name == "puma") {
    ratings = {turning(-160, 160, 82, 97.6),  turning(-110, 110, 54, 186.4),
               turning(-135, 135, 122, 89.4), turning(-110, 170, 228, 24.2),
               turning(-100, 100, 241, 20.1), turning(-266, 266, 228, 21.3)};
  } else if (name == "ur5") {
    for (const double torque : {150, 150, 150, 28, 28, 28}) {
      ratings.push_back(turning(-360, 360, 180, torque));
    }
  } else if (name == "panda") {
    ratings = {{-2.8973, 2.8973, 2.175, 87}, {-1.7628, 1.7628, 2.175, 87},
               {-2.8973, 2.8973, 2.175, 87}, {-3.0718, -.0698, 2.175, 87},
               {-2.8973, 2.8973, 2.61, 12},  {-.0175, 3.7525, 2.61, 12},
               {-2.8973, 2.8973, 2.61, 12}};
  }
  std::mt19937_64 random(1);
  Robot robot =
      ReadRobot(WriteFile(BlindArmYaml(name, &random), name + ".yaml"), {});
  for (size_t j = 0; j < ratings.size(); ++j) {
    Joint& joint = robot.links[j].joint;
    joint.lower = ratings[j].lower;
    joint.upper = ratings[j].upper;
    joint.velocity = ratings[j].velocity;
    joint.effort = ratings[j].effort;
  }
  return robot;
}

}  // namespace armcal
