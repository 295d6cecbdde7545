#include "tools/command.h"

#include "tools/calibrate.h"
#include "tools/simulate.h"
#include "tools/verify.h"

namespace armcal {

const std::vector<Command>& Commands() {
  static const std::vector<Command> kCommands = {
      CalibrateCommand(), SimulateCommand(), VerifyCommand()};
  return kCommands;
}

}  // namespace armcal
