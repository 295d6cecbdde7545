// write_predicted_torques ROBOT STATES SEED: random states of a robot and the
// torques that armcal says they take, as CSV: q1.., qd1.., qdd1.., rigid1..
// (rigid bodies alone), tau1.. (with armature, viscous and Coulomb friction).
// For tests/peers, which ask other engines the same.

#include <cstdlib>
#include <exception>
#include <iostream>
#include <random>

#include "model/dynamics/inverse_dynamics.h"
#include "model/robot_files/robot_reader.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

void Print(const VectorXd& values, bool last) {
  for (int j = 0; j < values.size(); ++j) {
    const bool ends = last && j + 1 == values.size();
    std::cout << values[j] << (ends ? "\n" : ",");
  }
}

void PrintHeader(int n) {
  for (const char* name : {"q", "qd", "qdd", "rigid", "tau"}) {
    for (int j = 1; j <= n; ++j) {
      const bool ends = std::string(name) == "tau" && j == n;
      std::cout << name << j << (ends ? "\n" : ",");
    }
  }
}

void WritePredictedTorques(const Robot& robot, int states, int seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const int n = robot.num_joints();
  const auto draw = [&](double size) {
    VectorXd values(n);
    for (double& value : values) value = size * uniform(random);
    return values;
  };
  std::cout.precision(17);
  PrintHeader(n);
  for (int k = 0; k < states; ++k) {
    const VectorXd q = draw(3), qd = draw(2), qdd = draw(5);
    const VectorXd rigid = InverseDynamics(robot, q, qd, qdd);
    VectorXd tau = rigid;
    for (int j = 0; j < n; ++j) {
      const Joint& joint = robot.links[j].joint;
      tau[j] += joint.armature * qdd[j] + joint.viscous * qd[j] +
                joint.coulomb * (qd[j] > 0 ? 1 : -1);
    }
    Print(q, false);
    Print(qd, false);
    Print(qdd, false);
    Print(rigid, false);
    Print(tau, true);
  }
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "write_predicted_torques ROBOT STATES SEED\n";
    return 2;
  }
  try {
    armcal::WritePredictedTorques(armcal::ReadRobot(argv[1], {}),
                                  std::atoi(argv[2]), std::atoi(argv[3]));
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 3;
  }
}
