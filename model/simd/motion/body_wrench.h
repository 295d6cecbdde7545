#pragma once

#include "model/simd/motion/moved_frame.h"
#include "model/simd/regressor/joint_screws.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// First and second moments of bodies about Mo, in M.
template <class T>
struct Moments {
  Vector3<T> h;
  SecondMoment<T> J;
};
template <class T>
ARMCAL_INLINE Moments<T> MomentsOf(const BodyConstants<T>& body) {
  const Vector3<T> x = body.Vector(kSecondMoment);
  const Vector3<T> y = body.Vector(kSecondMoment + 3);
  return {body.Vector(kFirstMoment), {x.x, x.y, x.z, y.x, y.y, y.z}};
}

// Of a wrench about the origin of one body's M, in it, about that before.
template <class T>
ARMCAL_INLINE Wrench<T> InParent(const MovedFrame<T>& frame,
                                 const Wrench<T>& wrench) {
  const Vector3<T> force = frame.InParent(wrench.force);
  return {frame.InParent(wrench.couple) + Cross(frame.p, force), force};
}

template <class T>
ARMCAL_INLINE T AlongJoint(const Wrench<T>& wrench, bool rotational) {
  return rotational ? wrench.couple.z : wrench.force.z;
}

// What of a wrench about Mo acts along the joint before.
template <class T>
ARMCAL_INLINE T AlongJointBefore(const MovedFrame<T>& frame,
                                 const Wrench<T>& wrench, bool rotational) {
  return rotational ? InParent(frame, wrench).couple.z
                    : frame.InParent(wrench.force).z;
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
