#include "tests/drive_gain_runs.h"

#include <memory>

#include "tests/temp_file.h"

namespace armcal {

DrivenArm Drive(const SimulatedArm& arm, std::mt19937_64* random) {
  DrivenArm driven{arm, {}, {}};
  driven.payload = InertialParameters::FromCenterOfMass(
      3, Eigen::Vector3d(.03, -.02, .06),
      Eigen::Vector3d(.010, .012, .006).asDiagonal());
  driven.K = UniformVector(random, arm.file.num_joints(), -4, 3).array().exp();
  return driven;
}

DrivenArm MakeDrivenArm(const std::string& name, std::mt19937_64* random) {
  return Drive(MakeArm(name, .3, random), random);
}

Robot Loaded(const DrivenArm& driven) {
  Robot robot = driven.arm.truth;
  robot.links.back().inertial += driven.payload;
  return robot;
}

Log ToCurrents(Log log, const Eigen::VectorXd& K) {
  log.tau = log.tau * K.cwiseInverse().asDiagonal();
  return log;
}

void AddDriveNoise(double current, double encoder, std::mt19937_64* random,
                   Log* log) {
  AddNoise(random, current * ColumnRms(log->tau), &log->tau);
  AddNoise(random, Eigen::VectorXd::Constant(log->q.cols(), encoder), &log->q);
}

std::string CurrentCsv(const Log& log) {
  std::string text = LogCsv(log);
  for (size_t at = text.find(",tau"); at != text.npos;
       at = text.find(",tau", at)) {
    text.replace(at, 4, ",i");
  }
  return text;
}

LinearCalibrationOptions DriveOptions() {
  LinearCalibrationOptions options;
  options.transition = kTransition;
  return options;
}

LinearCalibrationOptions ExactOptions() {
  LinearCalibrationOptions options = DriveOptions();
  options.bandwidth_hz = 0;
  return options;
}

DriveGains EstimateFromLogs(const Robot& robot, double payload_mass,
                            const std::vector<Log>& bare,
                            const std::vector<Log>& loaded,
                            const LinearCalibrationOptions& options) {
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  reader.torque_constants.assign(robot.num_joints(), 1);
  const auto write = [&](const std::vector<Log>& logs,
                         const std::string& name) {
    std::vector<std::string> paths;
    for (const Log& log : logs) {
      paths.push_back(WriteFile(CurrentCsv(log),
                                name + std::to_string(paths.size()) + ".csv"));
    }
    return std::make_unique<LogSet>(paths, reader, TimeRange());
  };
  const auto bare_set = write(bare, "bare");
  const auto loaded_set = loaded.empty() ? nullptr : write(loaded, "loaded");
  return EstimateDriveGains(robot, options, payload_mass, bare_set.get(),
                            loaded_set.get());
}

Currents::Currents(const DrivenArm& driven, double duration,
                   std::mt19937_64* random)
    : bare(ToCurrents(MoveArm(driven.arm.truth, duration, random), driven.K)),
      loaded(ToCurrents(MoveArm(Loaded(driven), duration, random), driven.K)) {}

}  // namespace armcal
