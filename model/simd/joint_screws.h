#pragma once

#include "model/simd/chain_constants.h"
#include "model/simd/sine_cosine.h"
#include "model/simd/vector3.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

template <class T>
ARMCAL_INLINE T LoadAs(const double* from) {
  T x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}
template <class T>
ARMCAL_INLINE void StoreAs(const T& x, double* to) {
  __builtin_memcpy(to, &x, sizeof x);
}

// Scratch on the stack.
#define ARMCAL_SCRATCH(type, count) \
  static_cast<type*>(               \
      __builtin_alloca_with_align((count) * sizeof(type) + sizeof(type), 512))

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

// How a unit of a joint's velocity moves the present link's frame, expressed in
// it: angular, and linear of its origin.
template <class T>
struct Screw {
  Vector3<T> angular, linear;
};

// To an origin that is moved by p.
template <class T, class Vector>
ARMCAL_INLINE void Shift(const Vector& p, Screw<T>* screw) {
  screw->linear = screw->linear + Cross(screw->angular, p);
}
// From P, and its origin, to L at Fo.
template <class T>
ARMCAL_INLINE void EnterLink(const LinkConstants& link, const Matrix3<T>& E,
                             Screw<T>* screw) {
  Shift(link.p_PF, screw);
  screw->angular = E * screw->angular;
  screw->linear = E * screw->linear;
}
// The link's own joint's, in L at Fo.
template <class T>
ARMCAL_INLINE Screw<T> OwnScrew(const LinkConstants& link) {
  return {Constant<T>(link.angular), Constant<T>(link.linear)};
}

template <class T>
struct Wrench {
  Vector3<T> couple, force;  // about the link's origin
};

template <class T>
ARMCAL_INLINE T Power(const Screw<T>& screw, const Wrench<T>& wrench) {
  return Dot(screw.angular, wrench.couple) + Dot(screw.linear, wrench.force);
}

// e x a, with e the unit vector of a first moment.
template <class T>
ARMCAL_INLINE Vector3<T> UnitCross(unsigned moment, const Vector3<T>& a) {
  const T zero = {};
  if (moment & (kHx | kSlidingHx)) return {zero, -a.z, a.y};
  if (moment & (kHy | kSlidingHy)) return {a.z, zero, -a.x};
  return {-a.y, a.x, zero};
}

// A set of moments that the compiler knows.
template <unsigned kMoments>
struct MomentSet {
  static constexpr unsigned kValue = kMoments;
};
template <class Function>
ARMCAL_INLINE void ForMoments(unsigned moments, const Function& function) {
  if (moments == kMomentsOfLink) {
    function(MomentSet<kMomentsOfLink>());
  } else if (moments == kMomentsOfJoint) {
    function(MomentSet<kMomentsOfJoint>());
  }
}

// One row's columns of one link, in as many outputs; kAll: every moment is
// wanted.
template <int kOutputs, bool kAll>
struct RowWriter {
  double* rows[kOutputs];
  long stride;
  const int* place;

  template <class T, class... More>
  ARMCAL_INLINE void Write(const T& value, const More&... more) {
    static_assert(1 + sizeof...(More) == kOutputs, "a value for each output");
    const int to = *place++;
    if (!kAll && to < 0) return;
    int output = 0;
    StoreAs(value, rows[output++] + to * stride);
    (StoreAs(more, rows[output++] + to * stride), ...);
  }
};

ARMCAL_INLINE const int* PlacesOfRow(const LinkConstants& link, int k) {
  return link.places + k * (link.num_moments + link.num_length_columns);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
