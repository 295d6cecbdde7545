#include "tools/commands/commanded_torques.h"

#include <gflags/gflags.h>

#include <memory>
#include <utility>

#include "calib/closed_loop/commanded_torque.h"
#include "tools/simulation_flags.h"

namespace armcal {
namespace {

constexpr unsigned kSeed = 1;  // the same answer to the same logs

}  // namespace

void MakeTorquesOfCommands(const FlagValues& flags, const Robot& robot,
                           const std::vector<std::string>& logs,
                           LogReaderOptions* options) {
  if (flags.Text("controller").empty()) return;
  LogReaderOptions reading = *options;
  reading.commands_do = true;
  for (const std::string& path : logs) {
    if (LogReader(path, reading).has_torque()) continue;
    const Log all = ReadWholeLog(path, reading);
    const CommandedLog log = CommandedRows(path, all, {});
    const ControllerOptions controller =
        ControllerFromFlags(flags, robot, log.log.qref.row(0));
    MadeTorque made = MakeTorque(robot, controller, log, all.t, kSeed);
    made.source = "commands and positions, by " + flags.Text("controller");
    options->made_torque[path] =
        std::make_shared<const MadeTorque>(std::move(made));
  }
}

}  // namespace armcal
