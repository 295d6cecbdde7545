#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/log_files/columns/log_signal.h"

namespace armcal {

// What headers of other programs call signals and units, beside NamesOf. A
// phrase is words in lower case, joined by blanks.

std::optional<Signal> SignalOf(const std::string& phrase);

// Whether a word changes nothing of what a column holds: "joint", "measured".
bool IsFiller(const std::string& word);

// Whether a word before a joint's name may make its column another quantity
// than the joint's own: a motor's angle, a desired position, an error.
bool TellsOtherQuantity(const std::string& word);

// The unit as NamesOf has it, or of time as FindTimeUnit knows it.
std::optional<std::string> UnitOf(std::string_view text);

}  // namespace armcal
