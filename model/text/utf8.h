#pragma once

#include <cstdint>
#include <string>

namespace armcal {

// Appends a character of Unicode.
void AppendUtf8(std::uint32_t c, std::string* text);

}  // namespace armcal
