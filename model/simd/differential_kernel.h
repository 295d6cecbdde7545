#pragma once

#include "model/simd/batches.h"
#include "model/simd/differential_joint_columns.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// U of samples `sample` and on, as many as T has: see BatchRegressor.
template <class T>
__attribute__((noinline)) void DifferentialAt(const ChainConstants& chain,
                                              const ChainMotion& motion,
                                              long sample, double* const* out,
                                              long stride) {
  auto* screws = ARMCAL_SCRATCH(Screw<T>, chain.num_links);
  auto* lengths = ARMCAL_SCRATCH(LengthAcceleration<T>, chain.num_lengths);
  Acceleration<T> at = AtRest<T>(chain);
  for (int i = 0; i < chain.num_links; ++i) {
    const LinkConstants& link = chain.links[i];
    const T q = LoadAs<T>(motion.q[i] + sample);
    const T qd = LoadAs<T>(motion.qd[i] + sample);
    const T qdd = LoadAs<T>(motion.qdd[i] + sample);
    const Matrix3<T> E = Rotation(link, q);
    EnterLink(chain, i, E, at, lengths);
    EnterLink(link, E, &at);
    AddJoint(link, qd, qdd, &at);
    for (int k = 0; k < i; ++k) EnterLink(link, E, &screws[k]);
    screws[i] = OwnScrew<T>(link);

    Slide<T> slide;
    const auto leave_joint = [&] {
      at.origin = at.origin + slide.acceleration;
      for (int k = 0; k <= i; ++k) Shift(slide.offset, &screws[k]);
    };
    if (link.has_offset) {
      slide.offset = Offset(link, q);
      slide.acceleration = OffsetAcceleration(link, slide.offset, qd, qdd, at);
      if (!link.regrouped) leave_joint();
    }
    const auto write = [&](auto moments) __attribute__((always_inline)) {
      WriteColumns<decltype(moments)::kValue>(link, i, at, screws, qd, qdd, out,
                                              sample, stride);
    };
    ForMoments(link.moments, write);
    if (link.moments & kSlidingMoments) {
      WriteSliding(link, i, at, slide, screws, out, sample, stride);
    }
    if (link.num_length_columns > 0) {
      WriteLengths(chain, i, lengths, at, slide, screws, out, sample, stride);
    }
    if (link.has_offset && link.regrouped) leave_joint();
  }
}

inline void DifferentialOfAll(const ChainConstants& chain,
                              const ChainMotion& motion, long count,
                              double* const* out, long stride) {
  const Output outputs[] = {{out, stride}};
  ForEachBatch(chain, motion, count, outputs,
               [&](const ChainMotion& of, long sample, const Output* to) {
                 DifferentialAt<Lanes>(chain, of, sample, to[0].rows,
                                       to[0].stride);
               });
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
