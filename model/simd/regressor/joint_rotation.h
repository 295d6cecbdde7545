#pragma once

#include "model/simd/lanes/sine_cosine.h"
#include "model/simd/lanes/vector3.h"
#include "model/simd/regressor/chain_constants.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

template <class T>
struct SineAndCosine {
  T sine, cosine;
};
// Of all joints' angles, which do not wait for one another.
ARMCAL_INLINE void SineCosineOfJoints(const ChainConstants& chain,
                                      const ChainMotion& motion, long sample,
                                      SineAndCosine<Lanes>* of) {
  for (int i = 0; i < chain.num_links; ++i) {
    if (chain.links[i].rotational) {
      SineCosine(Load(motion.q[i] + sample), &of[i].sine, &of[i].cosine);
    } else {
      of[i].sine = of[i].cosine = Lanes{};
    }
  }
}
// Of one sample: its joints are the lanes.
ARMCAL_INLINE void SineCosineOfJoints(const ChainConstants& chain,
                                      const ChainMotion& motion, long sample,
                                      SineAndCosine<double>* of) {
  for (int first = 0; first < chain.num_links; first += kLanes) {
    const int left = chain.num_links - first;
    const int joints = left < kLanes ? left : kLanes;
    Lanes q = {}, sine, cosine;
    for (int k = 0; k < joints; ++k) q[k] = motion.q[first + k][sample];
    SineCosine(q, &sine, &cosine);
    for (int k = 0; k < joints; ++k) of[first + k] = {sine[k], cosine[k]};
  }
}

// R_LP; of a prismatic joint Rc and Rs are 0.
template <class T>
ARMCAL_INLINE Matrix3<T> Rotation(const LinkConstants& link,
                                  const SineAndCosine<T>& q) {
  const auto entry = [&](int k) ARMCAL_LAMBDA {
    return q.sine * link.Rs[k] + (q.cosine * link.Rc[k] + link.R0[k]);
  };
  return {{entry(0), entry(1), entry(2)},
          {entry(3), entry(4), entry(5)},
          {entry(6), entry(7), entry(8)}};
}

// From Fo to Lo, in L.
template <class T>
ARMCAL_INLINE Vector3<T> Offset(const LinkConstants& link, const T& q) {
  const Vector3<T> constant = Constant<T>(link.p_ML);
  return link.rotational ? constant : constant + Times(link.axis, q);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
