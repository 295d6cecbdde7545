#pragma once

#include <string>

namespace armcal {

// printf to a string.
__attribute__((format(printf, 1, 2))) std::string Format(const char* format,
                                                         ...);

}  // namespace armcal
