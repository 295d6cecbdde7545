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
  const double w = kRounding * gap;
  const Corner ahead = CornerAt((deflection - gap / 2) / w);
  const Corner behind = CornerAt((-deflection - gap / 2) / w);
  const double pressed = w * (ahead.value - behind.value);
  const double touching = ahead.slope + behind.slope;
  return stiffness * pressed + damping * touching * rate;
}

}  // namespace armcal
