// Writes what a command test of drive gains needs to a folder: the robot file
// and logs of motor currents of a planar arm with two joints, bare and with a
// payload of 2 kg, torque constants 12 and 8 N m/A.

#include <fstream>
#include <string>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal {
namespace {

const char* const kRobot = R"(name: planar
gravity: [0, -9.81, 0]
convention: standard
links:
  - {joint: revolute, a: 0.5, mass: 4, com: [-0.2, 0, 0], inertia: [0.1, 0.1, 0.1]}
  - {joint: revolute, a: 0.4, mass: 3, com: [-0.2, 0.01, 0], inertia: [0.1, 0.1, 0.1]}
)";

Robot Planar() {
  Robot robot = SampleRobot("2R planar (vertical plane)");
  robot.links[0].inertial = InertialParameters::FromCenterOfMass(
      4, Eigen::Vector3d(-.2, 0, 0), Eigen::Matrix3d::Identity() * .1);
  robot.links[1].inertial = InertialParameters::FromCenterOfMass(
      3, Eigen::Vector3d(-.2, .01, 0), Eigen::Matrix3d::Identity() * .1);
  for (Link& link : robot.links) link.joint.viscous = .4;
  return robot;
}

// `moves`: joint 1 moves too.
void Write(const Robot& robot, bool moves, std::mt19937_64* random,
           const std::string& path) {
  Multisine motion = RandomMultisine(random, 2, 1.2);
  if (!moves) motion.amplitude.row(0).setZero();
  Log log = RecordMotion(motion, 20, .01);
  AddTorque(robot, &log);
  log.tau.col(0) /= 12;
  log.tau.col(1) /= 8;
  AddNoise(random, .01 * ColumnRms(log.tau), &log.tau);
  std::string csv = LogCsv(log);
  csv.replace(0, csv.find('\n'), "t,q1,q2,i1,i2");
  std::ofstream(path) << csv;
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  using namespace armcal;
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  std::ofstream(folder + "/planar.yaml") << kRobot;
  std::mt19937_64 random(3);
  Robot robot = Planar();
  Write(robot, true, &random, folder + "/bare.csv");
  Write(robot, true, &random, folder + "/bare2.csv");
  robot.links[1].inertial += InertialParameters::FromCenterOfMass(
      2, Eigen::Vector3d(.05, .02, 0), Eigen::Matrix3d::Identity() * .01);
  Write(robot, true, &random, folder + "/payload.csv");
  // In a horizontal plane the mass shows where joint 1 is accelerated alone.
  robot.gravity.setZero();
  Write(robot, false, &random, folder + "/horizontal_payload.csv");
  robot = Planar();
  robot.gravity.setZero();
  Write(robot, true, &random, folder + "/horizontal.csv");
}
