#pragma once

#include "model/simd/link_acceleration.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// One row's columns of one link: where the next goes.
struct RowWriter {
  double* row;
  long stride;
  const int* place;

  template <class T>
  ARMCAL_INLINE void Write(const T& value) {
    StoreAs(value, row + *place++ * stride);
  }
};

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

// The row of a joint with this screw. A unit of first moment along e needs the
// force B e and the couple e x a, with a the acceleration of the origin.
template <class T>
ARMCAL_INLINE void WriteMoments(unsigned moments, int num_couples,
                                const Vector3<T>* couples,
                                const Acceleration<T>& at,
                                const Screw<T>& screw, RowWriter* to) {
  for (int c = 0; c < num_couples; ++c) {
    to->Write(Dot(screw.angular, couples[c]));
  }
  if (moments & kMass) to->Write(Dot(screw.linear, at.origin));
  const Vector3<T> h =
      Cross(at.origin, screw.angular) + TransposedTimes(at.B, screw.linear);
  if (moments & kHx) to->Write(h.x);
  if (moments & kHy) to->Write(h.y);
  if (moments & kHz) to->Write(h.z);
}

// That of the link's own joint where Lo is on its axis, which is x, y or z of
// L.
template <class T, class Along>
ARMCAL_INLINE void WriteOwnMoments(const LinkConstants& link, unsigned moments,
                                   int num_couples, const Vector3<T>* couples,
                                   const Acceleration<T>& at,
                                   const Along& along, RowWriter* to) {
  for (int c = 0; c < num_couples; ++c) {
    to->Write(along(couples[c]) * link.axis_sign);
  }
  if (moments & kMass) to->Write(T{});
  const Vector3<T> h = Cross(at.origin, link.axis);
  if (moments & kHx) to->Write(h.x);
  if (moments & kHy) to->Write(h.y);
  if (moments & kHz) to->Write(h.z);
}

constexpr int CountBits(unsigned bits) {
  return bits == 0 ? 0 : static_cast<int>(bits & 1) + CountBits(bits >> 1);
}

// The columns of link i's moments that do not slide, in rows 0 to i; kMoments:
// which these are, 0: only `link` knows.
template <unsigned kMoments, class T>
ARMCAL_INLINE void WriteColumns(const LinkConstants& link, int i,
                                const Acceleration<T>& at,
                                const Screw<T>* screws, const T& qd,
                                const T& qdd, double* const* out, long offset,
                                long stride) {
  const unsigned moments = kMoments != 0 ? kMoments : link.moments;
  const int num_couples = kMoments != 0
                              ? CountBits(kMoments & (kMass - 1))
                              : __builtin_popcount(moments & (kMass - 1));
  Vector3<T> couples[CountBits(kMass - 1)];
  SetCouples(moments, at, couples);
  RowWriter own = {out[i] + offset, stride, PlacesOfRow(link, i)};
  const auto write_own = [&](const auto& along) ARMCAL_LAMBDA {
    WriteOwnMoments(link, moments, num_couples, couples, at, along, &own);
  };
  switch (link.axis_index) {
    case 0:
      write_own([](const Vector3<T>& couple) { return couple.x; });
      break;
    case 1:
      write_own([](const Vector3<T>& couple) { return couple.y; });
      break;
    case 2:
      write_own([](const Vector3<T>& couple) { return couple.z; });
      break;
    default:
      WriteMoments(moments, num_couples, couples, at, screws[i], &own);
  }
  if (moments & kIzzOfJoint) {
    couples[num_couples - 1] = {at.omega.y * qd, -(at.omega.x * qd), qdd};
  }
  for (int k = 0; k < i; ++k) {
    RowWriter to = {out[k] + offset, stride, PlacesOfRow(link, k)};
    WriteMoments(moments, num_couples, couples, at, screws[k], &to);
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
