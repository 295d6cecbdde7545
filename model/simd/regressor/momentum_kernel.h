#pragma once

#include "model/simd/regressor/batches.h"
#include "model/simd/regressor/momentum_joint_columns.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// P and D of samples `sample` and on, as many as T has: see BatchRegressor.
template <class T>
__attribute__((noinline)) void MomentumAt(const ChainConstants& chain,
                                          const ChainMotion& motion,
                                          long sample, double* const* P,
                                          double* const* D, long stride) {
  auto* joints = ARMCAL_SCRATCH(MovingScrew<T>, chain.num_links);
  auto* lengths = ARMCAL_SCRATCH(LengthVelocity<T>, chain.num_lengths);
  const MomentumOutput out = {P, D, sample, stride};
  auto* angles = ARMCAL_SCRATCH(SineAndCosine<T>, chain.num_links);
  SineCosineOfJoints(chain, motion, sample, angles);
  const Vector3<T> none = {};
  Velocity<T> at = {none, none, Constant<T>(chain.gravity)};
  for (int i = 0; i < chain.num_links; ++i) {
    const LinkConstants& link = chain.links[i];
    const T q = LoadAs<T>(motion.q[i] + sample);
    const T qd = LoadAs<T>(motion.qd[i] + sample);
    const Matrix3<T> E = Rotation(link, angles[i]);
    EnterLink(chain, i, E, at.omega, lengths);
    EnterLink(link, E, &at);
    for (int k = 0; k < i; ++k) {
      EnterLink(link, E, &joints[k].screw);
      EnterLink(link, E, &joints[k].change);
    }
    const Vector3<T> way = Times(link.axis, qd);
    if (link.rotational) at.omega = at.omega + way;
    joints[i] = OwnMovingScrew(link, at);

    if (link.has_offset) {
      SlideVelocity<T> slide;
      slide.offset = Offset(link, q);
      slide.velocity = Cross(at.omega, slide.offset);
      if (!link.rotational) slide.velocity = slide.velocity + way;
      if (link.regrouped) {
        WriteSliding(chain, i, at, slide, lengths, joints, out);
      }
      at.origin = at.origin + slide.velocity;
      for (int k = 0; k <= i; ++k) {
        Shift(slide.offset, &joints[k].screw);
        Shift(slide.offset, &joints[k].change);
      }
      if (link.regrouped) continue;
    }
    ForMoments(link, [&](auto moments) ARMCAL_LAMBDA {
      using Set = decltype(moments);
      WriteColumns<Set::kValue, Set::kAll>(link, i, at, joints, qd, out);
    });
    WriteLengths(chain, i, at, lengths, joints, out);
  }
}

inline void MomentumOfAll(const ChainConstants& chain,
                          const ChainMotion& motion, long count,
                          double* const* P, double* const* D, long stride) {
  const Output outputs[] = {{P, stride}, {D, stride}};
  ForEachBatch(chain, motion, count, outputs,
               [&](const ChainMotion& of, long sample, const Output* to) {
                 MomentumAt<Lanes>(chain, of, sample, to[0].rows, to[1].rows,
                                   to[0].stride);
               });
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
