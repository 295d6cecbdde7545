#pragma once

#include "model/simd/lanes/exponential.h"
#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

constexpr double kRounding = .002;  // FlankedSpring's

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
  constexpr double kFar = 60;  // where no corner is left, nor the other flank
  const Lanes w = kRounding * spring.gap;
  const Lanes side = d < 0 ? Broadcast(-1) : Broadcast(1);
  const Lanes x = Magnitude(d) / w - .5 / kRounding;
  const Lanes away = Magnitude(x);
  const Lanes tail = ExponentialOfMinus(away < kFar ? away : Broadcast(kFar));
  const Lanes share = 1 / (1 + tail);
  const Lanes pressed = Largest(x, Lanes{}) + LogarithmOfOneAnd(tail);
  const Lanes touching = x > 0 ? share : tail * share;
  const Lanes bend = tail * share * share;
  const Lanes damping = spring.damping * touching, closing = side * rate;
  const Lanes force = spring.stiffness * w * pressed + damping * closing;
  const Integers presses = force > 0;
  return {presses ? side * force : Lanes{},
          presses ? spring.stiffness * touching +
                        spring.damping * closing * bend / w
                  : Lanes{},
          presses ? damping : Lanes{}};
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
