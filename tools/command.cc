#include "tools/command.h"

#include "tools/calibrate.h"
#include "tools/diagnose.h"
#include "tools/excite.h"
#include "tools/inspect.h"
#include "tools/merge.h"
#include "tools/reduce.h"
#include "tools/simulate.h"
#include "tools/verify.h"

namespace armcal {

std::vector<std::string> Command::FlagNames() const {
  std::vector<std::string> names;
  for (const FlagGroup& group : groups) {
    names.insert(names.end(), group.flags.begin(), group.flags.end());
  }
  return names;
}

const std::vector<Command>& Commands() {
  static const std::vector<Command> kCommands = [] {
    std::vector<Command> commands = {CalibrateCommand(), VerifyCommand(),
                                     DiagnoseCommand(),  SimulateCommand(),
                                     ExciteCommand(),    InspectCommand(),
                                     ReduceCommand(),    MergeCommand()};
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
