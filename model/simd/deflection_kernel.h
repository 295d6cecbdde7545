#pragma once

#include "model/simd/deflected_link.h"
#include "model/simd/exponential.h"
#include "model/simd/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// A link in each lane. The steps are StiffStep's (model/stiff_step.h), but the
// rate is the only unknown of a stage and Newton's slope is exact. What a lane
// holds does not depend on the others.

constexpr double kGamma = .29289321881345247560;  // of both stages
constexpr double kRounding = .05;                 // FlankedSpring's

ARMCAL_INLINE Lanes Largest(const Lanes& a, const Lanes& b) {
  return a > b ? a : b;
}
ARMCAL_INLINE Lanes Magnitude(const Lanes& x) { return x < 0 ? -x : x; }

struct SpringLanes {
  Lanes gap, stiffness, damping;
};

// The law's torque and its slopes over deflection and rate.
struct SpringTorque {
  Lanes torque, by_deflection, by_rate;
};

ARMCAL_INLINE SpringTorque TorqueOf(const SpringLanes& spring, const Lanes& d,
                                    const Lanes& rate) {
  constexpr double kRounding = .05;                // FlankedSpring's
  constexpr double kGap = 2.06115362243855783e-9;  // exp(-1 / kRounding)
  constexpr double kFar = 60;                      // where no corner is left
  const Lanes w = kRounding * spring.gap;
  const Lanes side = d < 0 ? Broadcast(-1) : Broadcast(1);
  // The flank on this side; the other is so far that few terms are enough.
  const Lanes x = Magnitude(d) / w - .5 / kRounding;
  const Lanes away = Magnitude(x);
  const Lanes tail = ExponentialOfMinus(away < kFar ? away : Broadcast(kFar));
  const Lanes far = x > 0 ? tail * kGap : kGap / tail;
  const Lanes share = 1 / (1 + tail);
  const Lanes pressed = Largest(x, Lanes{}) + LogarithmOfOneAnd(tail) -
                        far * (1 - far * (.5 - far * (1. / 3)));
  const Lanes touching =
      (x > 0 ? share : tail * share) + far * (1 - far * (1 - far));
  const Lanes bend = tail * share * share - far * (1 - 2 * far);
  const Lanes damping = spring.damping * touching;
  return {side * spring.stiffness * w * pressed + damping * rate,
          spring.stiffness * touching + spring.damping * rate * side * bend / w,
          damping};
}

// Weights of InterpolateColumns (model/motion_track.h) at a stage.
struct StageWeights {
  Lanes at, next, slope_at, slope_next;
};

ARMCAL_INLINE StageWeights WeightsAt(const Lanes& share) {
  const Lanes s = share, r = 1 - share;
  return {r * r * (1 + 2 * s), s * s * (1 + 2 * r), s * r * r, -s * s * r};
}

// A signal from one sample to the next, and its slopes at both.
struct SignalPiece {
  Lanes at, next, slope_at, slope_next;
  ARMCAL_INLINE Lanes operator()(const StageWeights& w) const {
    return w.at * at + w.next * next + w.slope_at * slope_at +
           w.slope_next * slope_next;
  }
};

ARMCAL_INLINE Lanes Gather(const double* const* from, long sample) {
  Lanes x;
  for (int k = 0; k < kLanes; ++k) x[k] = from[k][sample];
  return x;
}

ARMCAL_INLINE SignalPiece PieceAt(const double* const* signal, long k,
                                  long last) {
  const bool first = k == 0, ends = k + 1 == last;
  const Lanes at = Gather(signal, k), next = Gather(signal, k + 1);
  const Lanes before = first ? at : Gather(signal, k - 1);
  const Lanes after = ends ? next : Gather(signal, k + 2);
  return {at, next, (next - before) * (first ? 1 : .5),
          (after - at) * (ends ? 1 : .5)};
}

// rate = rate_base + step (load - T(base + step_d rate, rate)), from a guess of
// the rate. Newton's steps square what is wrong in parts of a corner's width:
// the last that are this small need no check.
template <bool kHasGap>
ARMCAL_INLINE void SolveStage(const SpringLanes& spring, const Integers& active,
                              const Lanes& load, const Lanes& step,
                              const Lanes& step_d, const Lanes& base,
                              const Lanes& rate_base, Lanes* d, Lanes* rate) {
  constexpr int kMostIterations = 20;
  constexpr double kTolerance = 1e-10, kLastStep = 1e-6;
  Lanes v = *rate;
  if (kHasGap) {
    const Lanes last = kLastStep * kRounding * spring.gap;
    Integers open = active;
    for (int i = 0; i < kMostIterations; ++i) {
      const Lanes x = base + step_d * v;
      const SpringTorque T = TorqueOf(spring, x, v);
      const Lanes left = v - rate_base - step * (load - T.torque);
      const Lanes scale =
          Largest(Largest(Magnitude(x), Magnitude(v)), Broadcast(1e-12));
      open &= Magnitude(left) > kTolerance * scale;
      const Lanes slope = 1 + step * (T.by_deflection * step_d + T.by_rate);
      const Lanes change = left / slope;
      v = open ? v - change : v;
      open &= step_d * Magnitude(change) > last;
      if (All(open == 0)) break;
    }
  } else {
    v = (rate_base + step * (load - spring.stiffness * base)) /
        (1 + step * (spring.stiffness * step_d + spring.damping));
  }
  *rate = v;
  *d = base + step_d * v;
}

// As many links as there are lanes, all with a gap or all without.
template <bool kHasGap>
__attribute__((noinline)) void FollowLinks(const DeflectedLink* const* links,
                                           int count, long samples, double dt) {
  const double *load[kLanes], *inertia[kLanes];
  SpringLanes spring;
  Lanes d, rate, substeps;
  int most = 0;
  for (int k = 0; k < kLanes; ++k) {
    const DeflectedLink& link = *links[k < count ? k : 0];
    spring.gap[k] = link.gap;
    spring.stiffness[k] = link.stiffness;
    spring.damping[k] = link.damping;
    load[k] = link.load;
    inertia[k] = link.inertia;
    d[k] = link.start;
    rate[k] = link.start_rate;
    substeps[k] = link.substeps;
    if (link.substeps > most) most = link.substeps;
  }
  const Lanes h = .5 / substeps;
  auto* weights = ARMCAL_SCRATCH(StageWeights, 4 * most);
  for (int half = 0; half < 2; ++half) {
    for (int i = 0; i < most; ++i) {
      const Lanes begin =
          (static_cast<double>(half) * substeps + static_cast<double>(i)) * h;
      StageWeights* at = weights + 2 * (half * most + i);
      at[0] = WeightsAt(begin + kGamma * h);
      at[1] = WeightsAt(begin + h);
    }
  }
  const Lanes step_d = kGamma * dt * h;
  Lanes change = {};  // of the rate in the last step
  const auto advance = [&](const SignalPiece& loads,
                           const SignalPiece& inertias,
                           const StageWeights* at) ARMCAL_LAMBDA {
    for (int i = 0; i < most; ++i, at += 2) {
      const Integers active = substeps > static_cast<double>(i);
      // Guesses go on as the rate went before.
      Lanes x = d, v = rate + kGamma * change;
      SolveStage<kHasGap>(spring, active, loads(at[0]),
                          step_d / inertias(at[0]), step_d, d, rate, &x, &v);
      // What the first stage moved, which the second weighs by (1 - gamma).
      constexpr double kFirst = (1 - kGamma) / kGamma;
      const Lanes base = d + kFirst * (x - d);
      const Lanes rate_base = rate + kFirst * (v - rate);
      v = rate_base + (v - rate);
      SolveStage<kHasGap>(spring, active, loads(at[1]),
                          step_d / inertias(at[1]), step_d, base, rate_base, &x,
                          &v);
      change = active ? v - rate : change;
      d = active ? x : d;
      rate = active ? v : rate;
    }
  };
  Lanes before = rate;
  for (long k = 0; k < samples; ++k) {
    const bool first = k == 0, last = k + 1 == samples;
    for (int i = 0; i < count; ++i) {
      links[i]->angle[k] = d[i];
      links[i]->rate[k] = rate[i];
    }
    SignalPiece loads, inertias;
    if (!last) {
      loads = PieceAt(load, k, samples - 1);
      inertias = PieceAt(inertia, k, samples - 1);
      advance(loads, inertias, weights);
    }
    const double time = ((first ? 0 : .5) + (last ? 0 : .5)) * dt;
    for (int i = 0; i < count; ++i) {
      links[i]->acceleration[k] = time > 0 ? (rate[i] - before[i]) / time : 0;
    }
    before = rate;
    if (!last) advance(loads, inertias, weights + 2 * most);
  }
}

inline void FollowDeflectedLinks(const DeflectedLink* const* links, int count,
                                 long samples, double dt) {
  for (int k = 0; k < count;) {
    const bool has_gap = links[k]->gap > 0;
    int size = 1;
    while (size < kLanes && k + size < count &&
           (links[k + size]->gap > 0) == has_gap) {
      ++size;
    }
    (has_gap ? FollowLinks<true> : FollowLinks<false>)(links + k, size, samples,
                                                       dt);
    k += size;
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
