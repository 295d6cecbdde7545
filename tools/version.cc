#include "tools/version.h"

namespace armcal {

// What CMake found; Debian's packages keep a library's version within a
// release.
std::string VersionText() {
  return "armcal " ARMCAL_VERSION "\nCeres " CERES_VERSION
         ", Eigen " EIGEN_VERSION ", Simbody " SIMBODY_VERSION "\n";
}

}  // namespace armcal
