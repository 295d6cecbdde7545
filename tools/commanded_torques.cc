#include "tools/commanded_torques.h"

#include <gflags/gflags.h>

#include <memory>
#include <utility>

#include "calib/commanded_torque.h"
#include "model/input_error.h"
#include "tools/simulation_flags.h"

DECLARE_string(controller);

namespace armcal {
namespace {

// What an integral holds follows from the positions of every period; logs have
// a part of these, and errors that add up would pass for effects.
void ExpectNoIntegrals(const std::vector<DriveLaw>& drives) {
  for (size_t j = 0; j < drives.size(); ++j) {
    if (drives[j].ki == 0 && drives[j].velocity_ki == 0) continue;
    throw InputError(FLAGS_controller, "joint " + std::to_string(j + 1), "",
                     "has an integral gain: torques of logs that have none are "
                     "made of commands where ki (of a cascade velocity_ki) is "
                     "0 for all joints");
  }
}

}  // namespace

void MakeTorquesOfCommands(const Robot& robot,
                           const std::vector<std::string>& logs,
                           LogReaderOptions* options) {
  if (FLAGS_controller.empty()) return;
  LogReaderOptions reading = *options;
  reading.commands_do = true;
  for (const std::string& path : logs) {
    if (LogReader(path, reading).has_torque()) continue;
    const Log all = ReadWholeLog(path, reading);
    const CommandedLog log = CommandedRows(path, all, {});
    const ControllerOptions controller =
        ControllerFromFlags(robot, log.log.qref.row(0));
    ExpectNoIntegrals(controller.drives);
    MadeTorque made;
    made.tau = CommandedTorque(robot, controller, log, all.t);
    made.source = "commands and positions, by " + FLAGS_controller;
    options->made_torque[path] =
        std::make_shared<const MadeTorque>(std::move(made));
  }
}

}  // namespace armcal
