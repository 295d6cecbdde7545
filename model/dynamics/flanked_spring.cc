#include "model/dynamics/flanked_spring.h"

#include <algorithm>

namespace armcal {

double FlankedSpring::operator()(double deflection, double rate, const double*,
                                 double*) const {
  if (gap == 0) {
    const double stiffer = stiffening * deflection * deflection;
    return stiffness * deflection * (1 + stiffer) + damping * rate;
  }
  const double side = deflection < 0 ? -1 : 1, w = kRounding * gap;
  // A ramp whose corner at 0 is a parabola from -1 to 1, and its slope.
  const double x = side * deflection / w - .5 / kRounding;
  const double slope = std::clamp((1 + x) / 2, 0., 1.);
  const double ramp = x > 1 ? x : slope * slope;
  return side *
         std::max(0., stiffness * w * ramp + damping * slope * side * rate);
}

}  // namespace armcal
