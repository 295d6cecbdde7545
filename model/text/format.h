#pragma once

#include <string>

namespace armcal {

// printf to a string, with decimal points in any locale.
__attribute__((format(printf, 1, 2))) std::string Format(const char* format,
                                                         ...);

}  // namespace armcal
