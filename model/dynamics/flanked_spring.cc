#include "model/dynamics/flanked_spring.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

// ln(1 + e^x), a ramp with a rounded corner at 0, and its slope.
struct Corner {
  double value, slope;
};

Corner CornerAt(double x) {
  constexpr double kFar = 25;
  if (std::abs(x) > kFar) return {std::max(x, 0.), x > 0 ? 1. : 0.};
  const double tail = std::exp(-std::abs(x));
  return {std::max(x, 0.) + std::log1p(tail), (x > 0 ? 1 : tail) / (1 + tail)};
}

}  // namespace

double FlankedSpring::operator()(double deflection, double rate, const double*,
                                 double*) const {
  if (gap == 0) {
    const double stiffer = stiffening * deflection * deflection;
    return stiffness * deflection * (1 + stiffer) + damping * rate;
  }
  const double side = deflection < 0 ? -1 : 1, w = kRounding * gap;
  const Corner at = CornerAt(side * deflection / w - .5 / kRounding);
  return side * std::max(0., stiffness * w * at.value +
                                 damping * at.slope * side * rate);
}

}  // namespace armcal
