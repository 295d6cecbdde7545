#pragma once

#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Vectors of T = double (one sample) or T = Lanes (one in each lane), and of
// constants, which are the same for all samples.
template <class T>
struct Vector3 {
  T x, y, z;
};

template <class T>
ARMCAL_INLINE Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
ARMCAL_INLINE Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
ARMCAL_INLINE Vector3<T> operator*(const Vector3<T>& a, const T& b) {
  return {a.x * b, a.y * b, a.z * b};
}
template <class T>
ARMCAL_INLINE T Dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
ARMCAL_INLINE Vector3<T> Cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
ARMCAL_INLINE Vector3<T> Cross(const Vector3<T>& a, const double* b) {
  return {a.y * b[2] - a.z * b[1], a.z * b[0] - a.x * b[2],
          a.x * b[1] - a.y * b[0]};
}
template <class T>
ARMCAL_INLINE Vector3<T> Times(const double* a, const T& b) {
  return {a[0] * b, a[1] * b, a[2] * b};
}
template <class T>
ARMCAL_INLINE Vector3<T> Times(double a, const Vector3<T>& b) {
  return {a * b.x, a * b.y, a * b.z};
}
template <class T>
ARMCAL_INLINE Vector3<T> Constant(const double* a) {
  return {a[0] + T{}, a[1] + T{}, a[2] + T{}};
}

template <class T>
struct Matrix3 {
  Vector3<T> x, y, z;  // rows
};

template <class T>
ARMCAL_INLINE Vector3<T> operator*(const Matrix3<T>& m, const Vector3<T>& v) {
  return {Dot(m.x, v), Dot(m.y, v), Dot(m.z, v)};
}
template <class T>
ARMCAL_INLINE Vector3<T> operator*(const Matrix3<T>& m, const double* v) {
  return {m.x.x * v[0] + m.x.y * v[1] + m.x.z * v[2],
          m.y.x * v[0] + m.y.y * v[1] + m.y.z * v[2],
          m.z.x * v[0] + m.z.y * v[1] + m.z.z * v[2]};
}
template <class T>
ARMCAL_INLINE Vector3<T> TransposedTimes(const Matrix3<T>& m,
                                         const Vector3<T>& v) {
  return {m.x.x * v.x + m.y.x * v.y + m.z.x * v.z,
          m.x.y * v.x + m.y.y * v.y + m.z.y * v.z,
          m.x.z * v.x + m.y.z * v.y + m.z.z * v.z};
}
template <class T>
ARMCAL_INLINE Vector3<T> Column(const Matrix3<T>& m, int component) {
  return component == 0   ? Vector3<T>{m.x.x, m.y.x, m.z.x}
         : component == 1 ? Vector3<T>{m.x.y, m.y.y, m.z.y}
                          : Vector3<T>{m.x.z, m.y.z, m.z.z};
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
