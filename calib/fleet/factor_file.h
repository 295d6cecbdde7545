#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calib/fleet/reduction.h"

namespace armcal {

// The bytes of a factor file: a line with format and version; the length of a
// JSON text (8 bytes) and that text, which holds the model and all of the logs
// but their triangles; these, log by log and joint by joint, column by column
// down to the diagonal, 8 bytes a number (IEEE 754); SHA-256 of all that (32
// bytes). Little endian. The same bytes for the same reduction.
std::string FactorFileBytes(const Reduction& reduction);

// Throws InputError: another format, a newer version, an end that is missing,
// bytes that have changed since.
Reduction ParseFactorFile(const std::string& path, std::string_view bytes);
Reduction ReadFactorFile(const std::string& path);

}  // namespace armcal
