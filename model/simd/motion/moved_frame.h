#pragma once

#include "model/simd/lanes/sine_cosine.h"
#include "model/simd/lanes/vector3.h"
#include "model/simd/motion/arm_constants.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Numbers per T: 1, or one in each lane.
template <class T>
constexpr long kWidth = sizeof(T) / sizeof(double);

// The constants of one body.
template <class T>
class BodyConstants {
 public:
  ARMCAL_INLINE BodyConstants(const ArmConstants& arm, int body)
      : at_(arm.values + (3 + body * kNumBodyConstants) * kWidth<T>) {}
  ARMCAL_INLINE T operator[](int k) const {
    return LoadAs<T>(at_ + k * kWidth<T>);
  }
  ARMCAL_INLINE Vector3<T> Vector(int k) const {
    return {(*this)[k], (*this)[k + 1], (*this)[k + 2]};
  }

 private:
  const double* at_;
};

// Integrals of r r' dm.
template <class T>
struct SecondMoment {
  T xx, xy, xz, yy, yz, zz;
};

// How the frame M of a body lies in the one before.
template <class T>
struct MovedFrame {
  T cosine, sine;            // of angle + q about z
  T cosine_beta, sine_beta;  // then about x
  Vector3<T> p;              // m

  ARMCAL_INLINE Vector3<T> InParent(const Vector3<T>& v) const {
    const T x = cosine * v.x - sine * v.y, y = sine * v.x + cosine * v.y;
    return {x, cosine_beta * y - sine_beta * v.z,
            sine_beta * y + cosine_beta * v.z};
  }
  ARMCAL_INLINE Vector3<T> InChild(const Vector3<T>& v) const {
    const T y = cosine_beta * v.y + sine_beta * v.z;
    return {cosine * v.x + sine * y, cosine * y - sine * v.x,
            cosine_beta * v.z - sine_beta * v.y};
  }
  ARMCAL_INLINE SecondMoment<T> InParent(const SecondMoment<T>& J) const {
    const T u = cosine * J.xx - sine * J.xy, v = cosine * J.xy - sine * J.yy;
    const T xx = cosine * u - sine * v, xy = sine * u + cosine * v;
    const T yy = J.xx + J.yy - xx;
    const T xz = cosine * J.xz - sine * J.yz, yz = sine * J.xz + cosine * J.yz;
    const T w = cosine_beta * yy - sine_beta * yz;
    const T t = cosine_beta * yz - sine_beta * J.zz;
    const T turned = cosine_beta * w - sine_beta * t;
    return {xx,
            cosine_beta * xy - sine_beta * xz,
            sine_beta * xy + cosine_beta * xz,
            turned,
            sine_beta * w + cosine_beta * t,
            yy + J.zz - turned};
  }
};

template <class T>
struct JointAngle {
  T sine, cosine;
};
// Of all angles, which do not wait for one another.
ARMCAL_INLINE void SetAngles(const ArmConstants& arm, const Lanes* q,
                             JointAngle<Lanes>* angles) {
  for (int i = 0; i < arm.num_joints; ++i) {
    const Lanes angle = BodyConstants<Lanes>(arm, i)[kAngle];
    SineCosine(arm.joints[i].rotational ? angle + q[i] : angle, &angles[i].sine,
               &angles[i].cosine);
  }
}
// Of one arm: its joints are the lanes.
ARMCAL_INLINE void SetAngles(const ArmConstants& arm, const double* q,
                             JointAngle<double>* angles) {
  for (int first = 0; first < arm.num_joints; first += kLanes) {
    const int left = arm.num_joints - first;
    const int joints = left < kLanes ? left : kLanes;
    Lanes angle = {}, sine, cosine;
    for (int k = 0; k < joints; ++k) {
      const int i = first + k;
      angle[k] = BodyConstants<double>(arm, i)[kAngle];
      if (arm.joints[i].rotational) angle[k] += q[i];
    }
    SineCosine(angle, &sine, &cosine);
    for (int k = 0; k < joints; ++k) {
      angles[first + k] = {sine[k], cosine[k]};
    }
  }
}

// Of body i. Read where it is used: it is mostly constants.
template <class T>
ARMCAL_INLINE MovedFrame<T> FrameOf(const ArmConstants& arm, int i,
                                    const JointAngle<T>* angles, const T* q) {
  const BodyConstants<T> body(arm, i);
  MovedFrame<T> frame = {angles[i].cosine, angles[i].sine, body[kCosineBeta],
                         body[kSineBeta], body.Vector(kPosition)};
  if (!arm.joints[i].rotational) {
    frame.p.y = frame.p.y - frame.sine_beta * q[i];
    frame.p.z = frame.p.z + frame.cosine_beta * q[i];
  }
  return frame;
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
