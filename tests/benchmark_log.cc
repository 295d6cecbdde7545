#include "tests/benchmark_log.h"

#include <filesystem>
#include <random>

#include "model/robot_reader.h"
#include "tests/sample_motion.h"

namespace armcal {

Robot BenchmarkRobot() {
  const std::string shared = SHARED_DIR "/data/ur10e_free/robot.urdf";
  return ReadRobot(std::filesystem::exists(shared) ? shared
                                                   : DATA_DIR
                       "/six_axis/robot.urdf",
                   {});
}

Log BenchmarkLog(const Robot& robot, long samples) {
  constexpr double kStep = 1e-3;  // s
  std::mt19937_64 random(8);
  Log log = RecordMotion(RandomMultisine(&random, robot.num_joints()),
                         static_cast<double>(samples - 1) * kStep, kStep);
  AddTorque(robot, &log);
  return log;
}

}  // namespace armcal
