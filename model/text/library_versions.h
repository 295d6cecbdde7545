#pragma once

#include <string>
#include <vector>

namespace armcal {

// A shared library: the version whose headers armcal was compiled with, and the
// one that the system's loader found.
struct LibraryVersion {
  std::string name;
  std::string built;
  std::string loaded;

  // Of another major version, or older: what is called may be missing, or
  // another thing. Newer ones of the same major version keep their promises.
  bool fits() const;
};

// Those that say their version: what logs are unpacked and read with, and
// oneTBB. Ceres and Eigen are part of the program, Simbody's file name has its
// version.
std::vector<LibraryVersion> LoadedLibraries();

}  // namespace armcal
