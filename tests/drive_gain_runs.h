#pragma once

// Simulated arms with drives whose torque constants are known, with and without
// a payload, and what EstimateDriveGains makes of their currents.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "calib/drive_gains.h"
#include "tests/nonlinear_runs.h"
#include "tests/sample_motion.h"
#include "tests/sample_robots.h"
#include "tests/temp_file.h"

namespace armcal {

struct DrivenArm {
  SimulatedArm arm;
  InertialParameters payload;  // about the last link's frame
  Eigen::VectorXd K;           // N m/A or N/A
};

inline DrivenArm Drive(const SimulatedArm& arm, std::mt19937_64* random) {
  DrivenArm driven{arm, {}, {}};
  driven.payload = InertialParameters::FromCenterOfMass(
      3, Eigen::Vector3d(.03, -.02, .06),
      Eigen::Vector3d(.010, .012, .006).asDiagonal());
  driven.K = UniformVector(random, arm.file.num_joints(), -4, 3).array().exp();
  return driven;
}

// Torque constants from 0.02 to 20.
inline DrivenArm MakeDrivenArm(const std::string& name,
                               std::mt19937_64* random) {
  return Drive(MakeArm(name, .3, random), random);
}

inline Robot Loaded(const DrivenArm& driven) {
  Robot robot = driven.arm.truth;
  robot.links.back().inertial += driven.payload;
  return robot;
}

// Torques divided by the torque constants.
inline Log ToCurrents(Log log, const Eigen::VectorXd& K) {
  log.tau = log.tau * K.cwiseInverse().asDiagonal();
  return log;
}

// Noise of `current` times each joint's rms current, and of `encoder` rad or m.
inline void AddDriveNoise(double current, double encoder,
                          std::mt19937_64* random, Log* log) {
  AddNoise(random, current * ColumnRms(log->tau), &log->tau);
  AddNoise(random, Eigen::VectorXd::Constant(log->q.cols(), encoder), &log->q);
}

// A CSV with currents i1 .. in place of torques.
inline std::string CurrentCsv(const Log& log) {
  std::string text = LogCsv(log);
  for (size_t at = text.find(",tau"); at != text.npos;
       at = text.find(",tau", at)) {
    text.replace(at, 4, ",i");
  }
  return text;
}

inline LinearCalibrationOptions DriveOptions() {
  LinearCalibrationOptions options;
  options.transition = kTransition;
  return options;
}

inline LinearCalibrationOptions ExactOptions() {
  LinearCalibrationOptions options = DriveOptions();
  options.bandwidth_hz = 0;
  return options;
}

// Currents of the bare arm and of the arm with its payload, without noise.
struct Currents {
  Currents(const DrivenArm& driven, double duration, std::mt19937_64* random)
      : bare(ToCurrents(MoveArm(driven.arm.truth, duration, random), driven.K)),
        loaded(
            ToCurrents(MoveArm(Loaded(driven), duration, random), driven.K)) {}
  Log bare, loaded;
};

// EstimateDriveGains as a user meets it, on logs written to files. `loaded` may
// be empty.
inline DriveGains EstimateFromLogs(const Robot& robot, double payload_mass,
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

}  // namespace armcal
