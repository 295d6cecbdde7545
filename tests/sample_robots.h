#pragma once

#include <random>
#include <string>
#include <vector>

#include "model/robot.h"

namespace armcal {

// Well-known arms as standard DH tables, without inertia: "2R planar (vertical
// plane)", "2R planar (horizontal)", "3R elbow", "SCARA RRPR", "PUMA560 6R",
// "UR5 6R", "Panda 7R", "KUKA iiwa/LBR 7R" (the names of shared/gold.json).
Robot SampleRobot(const std::string& name);
std::vector<std::string> SampleRobotNames();

// Physically possible inertial parameters of every link, drawn at random.
void SetRandomInertials(std::mt19937_64* random, Robot* robot);

// A random serial arm of n joints: revolute or prismatic, twists and lengths
// that are zero, right-angled or generic, one of four gravity directions.
Robot RandomArm(int n, std::mt19937_64* random);

double Uniform(std::mt19937_64* random, double low, double high);
Eigen::VectorXd UniformVector(std::mt19937_64* random, int n, double low,
                              double high);

}  // namespace armcal
