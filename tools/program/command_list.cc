#include "tools/program/command_list.h"

#include "tools/commands/calibrate.h"
#include "tools/commands/compare.h"
#include "tools/commands/diagnose.h"
#include "tools/commands/excite.h"
#include "tools/commands/inspect.h"
#include "tools/commands/merge.h"
#include "tools/commands/reduce.h"
#include "tools/commands/simulate.h"
#include "tools/commands/verify.h"
#include "tools/commands/watch.h"

namespace armcal {

const std::vector<Command>& Commands() {
  static const std::vector<Command> kCommands = [] {
    std::vector<Command> commands = {
        CalibrateCommand(), VerifyCommand(), DiagnoseCommand(),
        SimulateCommand(),  ExciteCommand(), InspectCommand(),
        ReduceCommand(),    MergeCommand(),  CompareCommand(),
        WatchCommand(),
    };
    for (Command& command : commands) {
      command.groups.push_back(
          {"output", {"out", "json", "quiet", "flagfile"}});
      command.groups.push_back({"computation", {"threads"}, false});
    }
    return commands;
  }();
  return kCommands;
}

const Command* FindCommand(const std::string& name) {
  for (const Command& command : Commands()) {
    if (name == command.name) return &command;
  }
  return nullptr;
}

}  // namespace armcal
