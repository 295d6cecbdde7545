#pragma once

#include "tools/command.h"

namespace armcal {

// armcal compare: whether results of one robot agree within noise.
Command CompareCommand();

}  // namespace armcal
