#include "tools/commands/commanded_torques.h"

#include <memory>
#include <utility>

#include "calib/closed_loop/commanded_torque.h"
#include "tools/input_flags.h"
#include "tools/simulation_flags.h"

namespace armcal {
namespace {

constexpr unsigned kSeed = 1;  // the same answer to the same logs

}  // namespace

void MakeTorquesOfCommands(const CommandInput& input, const Robot& robot,
                           const std::vector<std::string>& logs,
                           LogReaderOptions* options) {
  const FlagValues& flags = input.flags;
  if (flags.Text("controller").empty()) return;
  LogReaderOptions reading = *options;
  reading.commands_do = true;
  for (const std::string& path : logs) {
    const LogSource source = SourceOf(input, path);
    if (LogReader(source, reading).has_torque()) continue;
    const Log all = ReadWholeLog(source, reading);
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
