#pragma once

#include "tools/command.h"

namespace armcal {

// armcal excite
Command ExciteCommand();

}  // namespace armcal
