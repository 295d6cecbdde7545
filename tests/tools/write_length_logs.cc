// Writes what a command test of unknown lengths needs to a folder: a UR5 whose
// robot file has other masses and lengths 8 % too long, as ur5.urdf; and logs
// of it, training.csv and held_out.csv, with noise of 1 % of the torque.

#include <fstream>
#include <string>

#include "model/robot_files/urdf_writer.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal {
namespace {

void WriteLog(const Robot& robot, double duration, std::mt19937_64* random,
              const std::string& path) {
  Log log = RecordMotion(RandomMultisine(random, robot.num_joints(), 1.2),
                         duration, .01);
  AddTorque(robot, &log);
  AddNoise(random, .01 * ColumnRms(log.tau), &log.tau);
  std::ofstream(path) << LogCsv(log);
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  using namespace armcal;
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  std::mt19937_64 random(5);
  Robot robot = SampleRobot("UR5 6R");
  robot.name = "ur5";
  SetRandomInertials(&random, &robot);
  Robot file = robot;
  for (int i = 0; i < robot.num_joints(); ++i) {
    robot.links[i].joint.viscous = .8;
    file.links[i].X_ML.translation() *= 1.08;
    Vector10d heavier = 1.2 * robot.links[i].inertial.ToVector();
    file.links[i].inertial = InertialParameters::FromVector(heavier);
  }
  std::ofstream(folder + "/ur5.urdf") << MakeUrdf(file);
  WriteLog(robot, 30, &random, folder + "/training.csv");
  WriteLog(robot, 10, &random, folder + "/held_out.csv");
}
