#include "tools/command.h"

#include "tools/calibrate.h"
#include "tools/diagnose.h"
#include "tools/excite.h"
#include "tools/inspect.h"
#include "tools/simulate.h"
#include "tools/verify.h"

namespace armcal {

const std::vector<Command>& Commands() {
  static const std::vector<Command> kCommands = {
      CalibrateCommand(), VerifyCommand(), DiagnoseCommand(),
      SimulateCommand(),  ExciteCommand(), InspectCommand()};
  return kCommands;
}

}  // namespace armcal
