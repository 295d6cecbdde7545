#pragma once

#include <cmath>

namespace armcal {

// The plant's sign of a velocity: algebraic, slope 1 / width at zero. Slower to
// its limit (1 - (width / v)^2 / 2) than the tanh of
// model/dynamics/joint_term.h.
//
// Stiffness: Coulomb friction F on an inertia I is a time constant of
// width I / F at zero velocity; 0.2 ms for 5 N m, 1 kg m^2 and 1 mrad/s.
inline double ZeroVelocitySign(double v, double width) {
  return v / std::hypot(v, width);
}

}  // namespace armcal
