#pragma once

#include <cstddef>

namespace armcal {

// Writes all of these bytes to a file descriptor, in as many calls as that
// takes: a pipe takes what it has room for. False where it cannot, errno then
// says why.
bool WriteAll(int descriptor, const char* bytes, std::size_t size);

}  // namespace armcal
