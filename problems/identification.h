#pragma once

namespace armcal {

// Which identification model turns motion into linear equations U X = Y.
enum class Identification {
  kWeak,          // test functions over sliding windows: weak_rows.h
  kDifferential,  // (2.19): differential_rows.h
  kIntegral       // (2.27): integral_rows.h
};
enum class Quadrature { kTrapezoid, kSimpson };

}  // namespace armcal
