#pragma once

namespace armcal {

// Where the parabola through three values a step apart is least, in steps from
// the middle one; 0 where it bends down or not at all.
inline double LowestBetween(double before, double here, double after) {
  const double curvature = before - 2 * here + after;
  return curvature > 0 ? (before - after) / (2 * curvature) : 0;
}

}  // namespace armcal
