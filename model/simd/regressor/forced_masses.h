#pragma once

#include "model/simd/regressor/link_acceleration.h"
#include "model/simd/regressor/mass_moments.h"
#include "model/simd/regressor/placed_link.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// How all points of a link accelerate, relative to free fall: of a point p that
// is `origin` + B p.
template <class T>
struct PlacedAcceleration {
  Vector3<T> origin;
  Matrix3<T> B;
};

// Of all masses behind a cut through the arm.
template <class T>
struct ForcedMasses {
  MassMoments<T> moments;
  Vector3<T> momentum;  // sum m x'
  Matrix3<T> spread;    // sum m x' x, a row per component of x'
  Wrench<T> wrench;     // that moves them
};

template <class T>
ARMCAL_INLINE Vector3<T> Axial(const Matrix3<T>& m) {
  return {m.z.y - m.y.z, m.x.z - m.z.x, m.y.x - m.x.y};
}

// sum m y x' of y = a + B x, and of y = v + w x x.
template <class T>
ARMCAL_INLINE Matrix3<T> Spread(const MassMoments<T>& of, const Vector3<T>& a,
                                const Matrix3<T>& B) {
  return {of.second * B.x + of.first * a.x, of.second * B.y + of.first * a.y,
          of.second * B.z + of.first * a.z};
}
template <class T>
ARMCAL_INLINE Matrix3<T> Spread(const MassMoments<T>& of,
                                const Screw<T>& twist) {
  const Symmetric3<T>& s = of.second;
  const Vector3<T> x = {s.xx, s.xy, s.xz}, y = {s.xy, s.yy, s.yz},
                   z = {s.xz, s.yz, s.zz};
  const Vector3<T>&w = twist.angular, &v = twist.linear;
  return {z * w.y - y * w.z + of.first * v.x,
          x * w.z - z * w.x + of.first * v.y,
          y * w.x - x * w.y + of.first * v.z};
}

template <class T>
ARMCAL_INLINE void AddBody(const MassMoments<T>& body,
                           const PlacedLink<T>& link,
                           const PlacedAcceleration<T>& acceleration,
                           ForcedMasses<T>* sums) {
  const Vector3<T>& a = acceleration.origin;
  const Matrix3<T>& B = acceleration.B;
  const Matrix3<T> K = Spread(body, link.twist);
  sums->moments = sums->moments + body;
  sums->momentum = sums->momentum + MomentumOf(body, link.twist).force;
  sums->spread = {sums->spread.x + K.x, sums->spread.y + K.y,
                  sums->spread.z + K.z};
  sums->wrench = {sums->wrench.couple + Axial(Spread(body, a, B)),
                  sums->wrench.force + a * body.mass + B * body.first};
}

// sum m x x (w x x'), of Coriolis' forces without their 2.
template <class T>
ARMCAL_INLINE Vector3<T> CoriolisCouple(const Matrix3<T>& spread,
                                        const Vector3<T>& w) {
  return w * (spread.x.x + spread.y.y + spread.z.z) - spread * w;
}

// How a joint responds when its masses move differently: by the power of
// `momentum` with X'', and of `coriolis` with w.
template <class T>
struct JointResponse {
  Wrench<T> momentum;
  Vector3<T> coriolis;
};

template <class T>
ARMCAL_INLINE JointResponse<T> ResponseOf(const ForcedMasses<T>& masses,
                                          const Screw<T>& joint) {
  const Matrix3<T>& K = masses.spread;
  const Vector3<T>& s = joint.angular;
  const Vector3<T> once = Cross(masses.momentum, joint.linear) +
                          s * (K.x.x + K.y.y + K.z.z) - TransposedTimes(K, s);
  return {MomentumOf(masses.moments, joint), once + once};
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
