#pragma once

#include "tools/command.h"

namespace armcal {

Command DiagnoseCommand();

}  // namespace armcal
