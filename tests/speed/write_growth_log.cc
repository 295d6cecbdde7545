// write_growth_log JOINTS SAMPLES FOLDER: robot.urdf and log.csv of a revolute
// arm of general geometry at 1 kHz, with q, qd, qdd and torques with 1 % of
// noise. For tests/speed/growth.py; in the memory of a chunk of samples.

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>

#include "model/robot_files/urdf_writer.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal {
namespace {

Robot GeneralArm(int joints, std::mt19937_64* random) {
  Robot robot;
  robot.name = "arm";
  for (int i = 0; i < joints; ++i) {
    Link link;
    link.name = "link" + std::to_string(i + 1);
    link.joint.name = "joint" + std::to_string(i + 1);
    link.X_PF.linear() = RotationFromRpy(UniformVector(random, 3, -2, 2));
    link.X_PF.translation() = UniformVector(random, 3, -.3, .3);
    robot.links.push_back(link);
  }
  SetRandomInertials(random, &robot);
  return robot;
}

// `samples` from `first` on.
Log Chunk(const Robot& robot, Multisine motion, long first, long samples) {
  constexpr double kStep = 1e-3;  // s
  const double t0 = static_cast<double>(first) * kStep;
  motion.phase += t0 * motion.omega;
  Log log =
      RecordMotion(motion, static_cast<double>(samples - 1) * kStep, kStep);
  log.t.array() += t0;
  AddTorque(robot, &log);
  return log;
}

void Write(int joints, long samples, const std::string& folder) {
  constexpr long kChunk = 10000;
  std::mt19937_64 random(joints);
  const Robot robot = GeneralArm(joints, &random);
  std::ofstream(folder + "/robot.urdf") << MakeUrdf(robot);
  const Multisine motion = RandomMultisine(&random, joints);
  std::ofstream csv(folder + "/log.csv");
  for (long first = 0; first < samples; first += kChunk) {
    Log log = Chunk(robot, motion, first, std::min(kChunk, samples - first));
    AddNoise(&random, .01 * ColumnRms(log.tau), &log.tau);
    const std::string text = LogCsv(log, true);
    csv << (first == 0 ? text : text.substr(text.find('\n') + 1));
  }
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "write_growth_log JOINTS SAMPLES FOLDER\n");
    return 2;
  }
  armcal::Write(std::stoi(argv[1]), std::stol(argv[2]), argv[3]);
}
