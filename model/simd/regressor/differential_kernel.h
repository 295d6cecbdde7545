#pragma once

#include "model/simd/regressor/batches.h"
#include "model/simd/regressor/differential_joint_columns.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// U of samples `sample` and on, as many as T has: see BatchRegressor.
template <class T>
__attribute__((noinline)) void DifferentialAt(const ChainConstants& chain,
                                              const ChainMotion& motion,
                                              long sample, double* const* out,
                                              long stride) {
  auto* screws = ARMCAL_SCRATCH(Screw<T>, chain.num_links);
  auto* lengths = ARMCAL_SCRATCH(LengthAcceleration<T>, chain.num_lengths);
  auto* angles = ARMCAL_SCRATCH(SineAndCosine<T>, chain.num_links);
  SineCosineOfJoints(chain, motion, sample, angles);
  Acceleration<T> at = AtRest<T>(chain);
  for (int i = 0; i < chain.num_links; ++i) {
    const LinkConstants& link = chain.links[i];
    const T q = LoadAs<T>(motion.q[i] + sample);
    const T qd = LoadAs<T>(motion.qd[i] + sample);
    const T qdd = LoadAs<T>(motion.qdd[i] + sample);
    const Matrix3<T> E = Rotation(link, angles[i]);
    EnterLink(chain, i, E, at, lengths);
    EnterLink(link, E, &at);
    AddJoint(link, qd, qdd, &at);
    for (int k = 0; k < i; ++k) EnterLink(link, E, &screws[k]);
    screws[i] = OwnScrew<T>(link);

    if (link.has_offset) {
      const Vector3<T> offset = Offset(link, q);
      const Slide<T> slide = {offset,
                              OffsetAcceleration(link, offset, qd, qdd, at)};
      if (link.regrouped) {
        WriteSliding(chain, i, at, slide, lengths, screws, out, sample, stride);
      }
      at.origin = at.origin + slide.acceleration;
      for (int k = 0; k <= i; ++k) Shift(offset, &screws[k]);
      if (link.regrouped) continue;
    }
    ForMoments(link, [&](auto moments) ARMCAL_LAMBDA {
      using Set = decltype(moments);
      DifferentialColumns<Set::kValue, Set::kAll, T>::WriteAll(
          link, i, at, screws, qd, qdd, out, sample, stride);
    });
    WriteLengths(chain, i, at, lengths, screws, out, sample, stride);
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
