// calibrate_arm ROBOT LOG: calibrates an arm on a log and prints what it found.

#include <exception>
#include <iostream>

#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration.h"
#include "calib/linear/calibration_report.h"
#include "model/robot_files/robot_reader.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: calibrate_arm ROBOT LOG\n";
    return 2;
  }
  try {
    const armcal::Robot robot = armcal::ReadRobot(argv[1], {});
    armcal::LogReaderOptions reading;
    reading.joint_names = robot.JointNames();
    armcal::LogSet logs({argv[2]}, reading, armcal::TimeRange());

    armcal::LinearCalibrationOptions options;
    options.bandwidth_hz = 10;
    const armcal::LinearCalibration result =
        armcal::CalibrateLinear(robot, options, logs, nullptr);
    if (!result.solved) {
      std::cerr << "not calibrated: " << result.reason << "\n";
      return 1;
    }
    std::cout.precision(5);
    const auto& parameters = result.parameters.parameters();
    for (int k = 0; k < result.x.size(); ++k) {
      std::cout << parameters[k].name << " = " << result.x[k] << " +- "
                << result.stddev[k] << " " << parameters[k].unit << "\n";
    }
    std::cout << armcal::BriefReport(robot, result) << "\n";
  } catch (const std::exception& error) {
    // What a file holds that cannot be used, with file, place and value.
    std::cerr << error.what() << "\n";
    return 3;
  }
}
