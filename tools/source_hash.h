#pragma once

namespace armcal {

// What this armcal was compiled from: 12 digits that cmake/source_hash.cmake
// makes of all sources, and writes the definition with.
const char* SourceHash();

}  // namespace armcal
