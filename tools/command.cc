#include "tools/command.h"

#include "tools/calibrate.h"
#include "tools/simulate.h"

namespace armcal {

const std::vector<Command>& Commands() {
  static const std::vector<Command> kCommands = {CalibrateCommand(),
                                                 SimulateCommand()};
  return kCommands;
}

}  // namespace armcal
