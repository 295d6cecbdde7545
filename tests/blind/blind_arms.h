#pragma once

#include <random>
#include <string>
#include <vector>

namespace armcal {

// The arms of the blind bench: "scara" (4 joints, one prismatic), "elbow" (3),
// "puma" and "ur5" (6), "panda" (7); geometry as in the literature, masses and
// friction of that size.
const std::vector<std::string>& BlindArmNames();

// A robot file (YAML with a DH table) of such an arm, masses, friction and
// armature scaled at random so that no two cases have the same. Links are
// cylinders between their joints.
std::string BlindArmYaml(const std::string& name, std::mt19937_64* random);

}  // namespace armcal
