#pragma once

#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

constexpr double kRounding = .005;  // FlankedSpring's

ARMCAL_INLINE Lanes Largest(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}
ARMCAL_INLINE Lanes Magnitude(const Lanes& x) { return x < 0 ? -x : x; }

struct SpringLanes {
  Lanes gap, stiffness, damping, stiffening;
};

// The law's torque and its slopes over deflection and rate.
struct SpringTorque {
  Lanes torque, by_deflection, by_rate;
};

// Without a gap.
ARMCAL_INLINE SpringTorque GaplessTorqueOf(const SpringLanes& spring,
                                           const Lanes& d, const Lanes& rate) {
  const Lanes stiffer = spring.stiffening * d * d;
  return {spring.stiffness * d * (1 + stiffer) + spring.damping * rate,
          spring.stiffness * (1 + 3 * stiffer), spring.damping};
}

ARMCAL_INLINE SpringTorque TorqueOf(const SpringLanes& spring, const Lanes& d,
                                    const Lanes& rate) {
  const Lanes w = kRounding * spring.gap;
  const Lanes side = d < 0 ? Broadcast(-1) : Broadcast(1);
  const Lanes x = Magnitude(d) / w - .5 / kRounding;
  const Lanes rise = Largest(.5 * (1 + x), Lanes{});
  const Lanes slope = x > 1 ? Broadcast(1) : rise;
  const Lanes ramp = x > 1 ? x : rise * rise;
  const Lanes bend = Magnitude(x) < 1 ? Broadcast(.5) : Lanes{};
  const Lanes damping = spring.damping * slope, closing = side * rate;
  const Lanes force = spring.stiffness * w * ramp + damping * closing;
  const Integers presses = force > 0;
  return {presses ? side * force : Lanes{},
          presses
              ? spring.stiffness * slope + spring.damping * closing * bend / w
              : Lanes{},
          presses ? damping : Lanes{}};
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
