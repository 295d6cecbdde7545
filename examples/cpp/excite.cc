// excite ROBOT: the motion of 10 s, within .8 of its limits, that tells most
// about an arm, as a log to follow.

#include "calib/excite.h"

#include <iostream>

#include "model/robot_files/robot_reader.h"

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  const armcal::Robot robot = armcal::ReadRobot(argv[1], {});
  armcal::ExciteOptions options;
  options.duration_s = 10;
  options.limits.use = .8;
  const armcal::ExciteSummary result = armcal::Excite(robot, options);
  std::cout << result << result.motion.size() << " samples\n";
  armcal::WriteFiles(result, "motion");
  return result.positive ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 3;
}
