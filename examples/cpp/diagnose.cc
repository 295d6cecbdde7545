// diagnose ROBOT LOG REFERENCE: what has changed since a log from before?

#include "calib/diagnose.h"

#include <iostream>

#include "model/robot_files/robot_reader.h"

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  const armcal::Robot robot = armcal::ReadRobot(argv[1], {});
  armcal::DiagnoseOptions options;
  options.reference.logs = {argv[3]};
  const armcal::DiagnoseSummary result =
      armcal::Diagnose(robot, {{argv[2]}}, options);
  std::cout << result.verdict << "\n";
  for (const armcal::DiagnosedEffect& effect : result.effects) {
    std::cout << effect.name << " " << effect.joint << ", probability "
              << effect.probability << ", removes " << effect.removed_percent
              << " % of the gap\n";
  }
  return result.positive ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 3;
}
