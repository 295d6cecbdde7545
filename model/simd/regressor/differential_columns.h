#pragma once

#include "model/simd/regressor/link_acceleration.h"
#include "model/simd/regressor/row_writer.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// What a unit of each second moment needs to move as its link does,
// I alpha + omega x I omega, in the order of their bits.
template <class T>
ARMCAL_INLINE void SetCouples(unsigned moments, const Acceleration<T>& at,
                              Vector3<T>* couple) {
  const Vector3<T>&w = at.omega, &v = at.alpha;
  const T xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const T xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
  if (moments & kIxx) *couple++ = {v.x, xz, -xy};
  if (moments & kIxy) *couple++ = {v.y - xz, v.x + yz, xx - yy};
  if (moments & kIyy) *couple++ = {-yz, v.y, xy};
  if (moments & kIxz) *couple++ = {v.z + xy, zz - xx, v.x - yz};
  if (moments & kIyz) *couple++ = {yy - zz, v.z - xy, v.y + xz};
  if (moments & kIzz) *couple++ = {yz, -xz, v.z};
  if (moments & kIxxMinusIyy) *couple++ = {v.x + yz, xz - v.y, -2 * xy};
  if (moments & kIzzOfJoint) *couple++ = {yz, -xz, v.z};
}

constexpr int CountBits(unsigned bits) {
  return bits == 0 ? 0 : static_cast<int>(bits & 1) + CountBits(bits >> 1);
}

// The columns of link i's moments, which do not slide, in rows 0 to i.
template <unsigned kMoments, bool kAll, class T>
struct DifferentialColumns {
  static constexpr int kCouples = CountBits(kMoments & (kMass - 1));
  using Writer = RowWriter<1, kAll>;

  // The row of a joint with this screw. A unit of first moment along e needs
  // the force B e and the couple e x a, with a the origin's acceleration.
  ARMCAL_INLINE static void Write(const Vector3<T>* couples,
                                  const Acceleration<T>& at,
                                  const Screw<T>& screw, Writer to) {
    for (int c = 0; c < kCouples; ++c) {
      to.Write(Dot(screw.angular, couples[c]));
    }
    if (kMoments & kMass) to.Write(Dot(screw.linear, at.origin));
    const Vector3<T> h =
        Cross(at.origin, screw.angular) + TransposedTimes(at.B, screw.linear);
    if (kMoments & kHx) to.Write(h.x);
    if (kMoments & kHy) to.Write(h.y);
    if (kMoments & kHz) to.Write(h.z);
  }

  // That of the link's own joint where Lo is on its axis, x, y or z of L.
  template <class Along>
  ARMCAL_INLINE static void WriteOwn(const LinkConstants& link,
                                     const Vector3<T>* couples,
                                     const Acceleration<T>& at,
                                     const Along& along, Writer to) {
    for (int c = 0; c < kCouples; ++c) {
      to.Write(along(couples[c]) * link.axis_sign);
    }
    if (kMoments & kMass) to.Write(T{});
    const Vector3<T> h = Cross(at.origin, link.axis);
    if (kMoments & kHx) to.Write(h.x);
    if (kMoments & kHy) to.Write(h.y);
    if (kMoments & kHz) to.Write(h.z);
  }

  ARMCAL_INLINE static void WriteAll(const LinkConstants& link, int i,
                                     const Acceleration<T>& at,
                                     const Screw<T>* screws, const T& qd,
                                     const T& qdd, double* const* out,
                                     long offset, long stride) {
    Vector3<T> couples[kCouples];
    SetCouples(kMoments, at, couples);
    const auto row = [&](int k) ARMCAL_LAMBDA {
      return Writer{{out[k] + offset}, stride, PlacesOfRow(link, k)};
    };
    switch (link.axis_index) {
      case 0:
        WriteOwn(
            link, couples, at, [](auto& v) { return v.x; }, row(i));
        break;
      case 1:
        WriteOwn(
            link, couples, at, [](auto& v) { return v.y; }, row(i));
        break;
      case 2:
        WriteOwn(
            link, couples, at, [](auto& v) { return v.z; }, row(i));
        break;
      default:
        Write(couples, at, screws[i], row(i));
    }
    if (kMoments & kIzzOfJoint) {
      couples[kCouples - 1] = {at.omega.y * qd, -(at.omega.x * qd), qdd};
    }
    for (int k = 0; k < i; ++k) Write(couples, at, screws[k], row(k));
  }
};

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
