#include "tools/command.h"

#include "tools/calibrate.h"

namespace armcal {

const std::vector<Command>& Commands() {
  static const std::vector<Command> kCommands = {CalibrateCommand()};
  return kCommands;
}

}  // namespace armcal
