// verify ROBOT LOG: does Simbody say the same of a robot, and what does the
// robot do along the log?

#include "calib/verify.h"

#include <iostream>

#include "model/robot_files/robot_reader.h"

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  const armcal::Robot robot = armcal::ReadRobot(argv[1], {});
  const armcal::VerifySummary result =
      armcal::Verify(robot, {{argv[2]}}, armcal::VerifyOptions());
  std::cout << result;
  for (const std::string& sentence : result.shortcomings) {
    std::cout << "wrong: " << sentence << "\n";
  }
  return result.positive ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 3;
}
