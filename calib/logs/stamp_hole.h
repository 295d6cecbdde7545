#pragma once

namespace armcal {

// Whether a step of a log's stamps, s, is a hole beside its usual step: of more
// than three steps, and of a quarter of the period of the 8 Hz to which torques
// are compared. Motion is not known over a longer one.
inline bool IsHole(double step, double usual) {
  constexpr double kHole = .03125;
  return step > 3 * usual && step > kHole;
}

}  // namespace armcal
