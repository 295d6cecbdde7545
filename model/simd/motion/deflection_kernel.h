#pragma once

#include "model/simd/lanes/lanes.h"
#include "model/simd/lanes/signal_piece.h"
#include "model/simd/motion/deflected_link.h"
#include "model/simd/motion/spring_torque.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// A link in each lane. The steps are StiffStep's (model/signals/stiff_step.h),
// but the rate is the only unknown of a stage and Newton's slope is exact. What
// a lane holds does not depend on the others.

constexpr double kSdirkGamma = .29289321881345247560;  // of both stages

// What the links need at a stage, and its slopes over the joint's position and
// rate.
struct LoadLanes {
  Lanes torque, stiffness, damping;
};

// With x = base + step_d rate,
//   rate = rate_base + step (load - stiffness x - damping rate - T(x, rate)),
// from a guess of the rate. Newton's steps square what is wrong in parts of a
// corner's width: the last that are this small need no check.
template <DeflectedLink::Kind kKind>
ARMCAL_INLINE void SolveStage(const SpringLanes& spring, const Integers& active,
                              const LoadLanes& load, const Lanes& step,
                              const Lanes& step_d, const Lanes& base,
                              const Lanes& rate_base, Lanes* d, Lanes* rate) {
  constexpr int kMostIterations = 20;
  constexpr double kTolerance = 1e-10, kLastStep = 1e-6;
  constexpr bool kHasGap = kKind == DeflectedLink::Kind::kFlanked;
  Lanes v = *rate;
  if (kKind != DeflectedLink::Kind::kLinear) {
    const Lanes last = kLastStep * kRounding * spring.gap;
    Integers open = active;
    for (int i = 0; i < kMostIterations; ++i) {
      const Lanes x = base + step_d * v;
      const SpringTorque T =
          kHasGap ? TorqueOf(spring, x, v) : GaplessTorqueOf(spring, x, v);
      const Lanes links = load.stiffness * x + load.damping * v;
      const Lanes left =
          v - rate_base - step * (load.torque - links - T.torque);
      const Lanes scale =
          Largest(Largest(Magnitude(x), Magnitude(v)), Broadcast(1e-12));
      open &= Magnitude(left) > kTolerance * scale;
      if (All(open == 0)) break;
      const Lanes by_deflection = T.by_deflection + load.stiffness;
      const Lanes by_rate = T.by_rate + load.damping;
      const Lanes slope = 1 + step * (by_deflection * step_d + by_rate);
      const Lanes change = left / slope;
      v = open ? v - change : v;
      open &= step_d * Magnitude(change) > last;
      if (All(open == 0)) break;
    }
  } else {
    const Lanes stiffness = spring.stiffness + load.stiffness;
    const Lanes damping = spring.damping + load.damping;
    v = (rate_base + step * (load.torque - stiffness * base)) /
        (1 + step * (stiffness * step_d + damping));
  }
  *rate = v;
  *d = base + step_d * v;
}

// From one sample to the next.
struct LinkPieces {
  SignalPiece load, stiffness, damping, inertia;
  ARMCAL_INLINE LoadLanes LoadAt(const StageWeights& at) const {
    return {load(at), stiffness(at), damping(at)};
  }
};

// As many links as there are lanes, all of one kind.
template <DeflectedLink::Kind kKind>
struct LinkLanes {
  const double *load[kLanes], *stiffness[kLanes], *damping[kLanes],
      *inertia[kLanes];
  SpringLanes spring;
  Lanes d, rate;
  Lanes change;  // of the rate in the last step
  Lanes substeps, step_d;
  int most;  // substeps

  ARMCAL_INLINE LinkLanes(const DeflectedLink* const* links, int count,
                          double dt)
      : most(0) {
    for (int k = 0; k < kLanes; ++k) {
      const DeflectedLink& link = *links[k < count ? k : 0];
      load[k] = link.along.load;
      stiffness[k] = link.along.stiffness;
      damping[k] = link.along.damping;
      inertia[k] = link.along.inertia;
      spring.gap[k] = link.gap;
      spring.stiffness[k] = link.stiffness;
      spring.damping[k] = link.damping;
      spring.stiffening[k] = link.stiffening;
      d[k] = link.start;
      rate[k] = link.start_rate;
      substeps[k] = link.substeps;
      if (link.substeps > most) most = link.substeps;
    }
    change = Lanes{};
    step_d = kSdirkGamma * dt * .5 / substeps;
  }

  // Of both stages of all steps of a sample, 4 `most`.
  ARMCAL_INLINE void SetWeights(StageWeights* weights) const {
    const Lanes h = .5 / substeps;
    for (int half = 0; half < 2; ++half) {
      for (int i = 0; i < most; ++i) {
        const Lanes begin =
            (static_cast<double>(half) * substeps + static_cast<double>(i)) * h;
        *weights++ = WeightsAt(begin + kSdirkGamma * h);
        *weights++ = WeightsAt(begin + h);
      }
    }
  }

  // Half a sample.
  ARMCAL_INLINE void Advance(const LinkPieces& pieces, const StageWeights* at) {
    for (int i = 0; i < most; ++i, at += 2) {
      const Integers active = substeps > static_cast<double>(i);
      // Guesses go on as the rate went before.
      Lanes x = d, v = rate + kSdirkGamma * change;
      SolveStage<kKind>(spring, active, pieces.LoadAt(at[0]),
                        step_d / pieces.inertia(at[0]), step_d, d, rate, &x,
                        &v);
      // What the first stage moved, which the second weighs by (1 - gamma).
      constexpr double kFirst = (1 - kSdirkGamma) / kSdirkGamma;
      const Lanes base = d + kFirst * (x - d);
      const Lanes rate_base = rate + kFirst * (v - rate);
      v = rate_base + (v - rate);
      SolveStage<kKind>(spring, active, pieces.LoadAt(at[1]),
                        step_d / pieces.inertia(at[1]), step_d, base, rate_base,
                        &x, &v);
      change = active ? v - rate : change;
      d = active ? x : d;
      rate = active ? v : rate;
    }
  }
};

template <DeflectedLink::Kind kKind>
__attribute__((noinline)) void FollowLinks(const DeflectedLink* const* links,
                                           int count, long samples, double dt) {
  LinkLanes<kKind> lanes(links, count, dt);
  auto* weights = ARMCAL_SCRATCH(StageWeights, 4 * lanes.most);
  lanes.SetWeights(weights);
  Lanes before = lanes.rate;
  SignalPieces load(lanes.load, samples), stiffness(lanes.stiffness, samples);
  SignalPieces damping(lanes.damping, samples), inertia(lanes.inertia, samples);
  for (long k = 0; k < samples; ++k) {
    const bool first = k == 0, last = k + 1 == samples;
    for (int i = 0; i < count; ++i) {
      links[i]->angle[k] = lanes.d[i];
      links[i]->rate[k] = lanes.rate[i];
    }
    LinkPieces pieces;
    if (!last) {
      pieces = {load.MoveTo(k), stiffness.MoveTo(k), damping.MoveTo(k),
                inertia.MoveTo(k)};
      lanes.Advance(pieces, weights);
    }
    const double time = ((first ? 0 : .5) + (last ? 0 : .5)) * dt;
    for (int i = 0; i < count; ++i) {
      links[i]->acceleration[k] =
          time > 0 ? (lanes.rate[i] - before[i]) / time : 0;
    }
    before = lanes.rate;
    if (!last) lanes.Advance(pieces, weights + 2 * lanes.most);
  }
}

inline void FollowDeflectedLinks(const DeflectedLink* const* links, int count,
                                 long samples, double dt) {
  using Kind = DeflectedLink::Kind;
  for (int k = 0; k < count;) {
    const Kind kind = links[k]->kind();
    int size = 1;
    while (size < kLanes && k + size < count &&
           links[k + size]->kind() == kind) {
      ++size;
    }
    const auto follow = kind == Kind::kFlanked ? FollowLinks<Kind::kFlanked>
                        : kind == Kind::kStiffening
                            ? FollowLinks<Kind::kStiffening>
                            : FollowLinks<Kind::kLinear>;
    follow(links + k, size, samples, dt);
    k += size;
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
