#pragma once

#include <optional>

#include "tests/blind/blind_label.h"

namespace armcal {

// What an answer really removes, in %: the mean squares that the same diagnosis
// leaves of held-out motion without noise (`quiet`: its answer there), where
// the floor is 0. Nothing where it did not claim the same there.
std::optional<double> TrueRemovedPercent(const BlindAnswer& answer,
                                         const BlindAnswer& quiet);

}  // namespace armcal
