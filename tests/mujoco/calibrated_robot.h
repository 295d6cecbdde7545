#pragma once

// Robots calibrated on logs of shared/data.

#include <string>
#include <vector>

#include "calib/linear/calibrate_linear.h"
#include "calib/refine/nonlinear_calibration.h"
#include "model/robot_files/robot_reader.h"

namespace armcal {

// The physically consistent robot of a log of shared/data; currents where
// torque constants are given.
inline Robot CalibratedRobot(const std::string& folder, const std::string& log,
                             double bandwidth_hz,
                             const std::vector<double>& torque_constants) {
  const std::string data = SHARED_DIR "/data/" + folder;
  const Robot robot = ReadRobot(data + "robot.urdf", {});
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  reader.torque_constants = torque_constants;
  LogSet logs({data + log}, reader, {});
  LinearCalibrationOptions options;
  options.bandwidth_hz = bandwidth_hz;
  const auto linear = CalibrateLinear(robot, options, logs, nullptr);
  return CalibrateNonlinear(robot, linear, {}, logs, nullptr).robot;
}

inline Robot CalibratedUr10e() {
  return CalibratedRobot("ur10e_free/", "id_30s.csv", 6,
                         {14.87, 13.26, 11.13, 10.62, 11.03, 11.47});
}

}  // namespace armcal
