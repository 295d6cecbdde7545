#include "tools/version.h"

#include "model/text/input_error.h"
#include "model/text/library_versions.h"
#include "tools/source_hash.h"

namespace armcal {

std::string VersionText() {
  // What CMake found is linked in, or has its version in the file's name.
  std::string text = "armcal " ARMCAL_VERSION " (sources ";
  text += SourceHash();
  text += ")\nCeres " CERES_VERSION ", Eigen " EIGEN_VERSION
          ", Simbody " SIMBODY_VERSION;
  const char* separator = "\n";
  for (const LibraryVersion& library : LoadedLibraries()) {
    text += separator + library.name + " " + library.loaded;
    if (library.loaded != library.built) {
      text += " (compiled with " + library.built + ")";
    }
    separator = ", ";
  }
  return text + "\n";
}

void CheckLibraryVersions() {
  for (const LibraryVersion& library : LoadedLibraries()) {
    if (library.fits()) continue;
    throw InputError("the library " + library.name, "version", library.loaded,
                     "armcal was compiled with " + library.built +
                         " and expected that or a newer one of the same major "
                         "version; install it, or compile armcal again");
  }
}

}  // namespace armcal
