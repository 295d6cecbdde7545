// calibrate ROBOT LOG: calibrates an arm and writes what the command would.

#include "calib/calibrate.h"

#include <iostream>

#include "model/robot_files/robot_reader.h"

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  const armcal::Robot robot = armcal::ReadRobot(argv[1], {});
  armcal::CalibrateOptions options;
  options.equations.bandwidth_hz = 10;
  const armcal::CalibrateSummary result =
      armcal::Calibrate(robot, {{argv[2]}}, options);
  for (const armcal::EstimatedParameter& p : result.parameters) {
    std::cout << p.name << " = " << p.value << " +- " << p.stddev << " "
              << p.unit << "\n";
  }
  std::cout << result.brief << "\n";
  armcal::WriteFiles(result, "calibrated");
  return result.positive ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";  // the file, the place and the value
  return 3;
}
