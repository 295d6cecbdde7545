#pragma once

#include "model/simd/regressor/geometry_constants.h"
#include "model/simd/regressor/joint_screws.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// A link's frame and motion in W, the first link's P, and about Wo: what sums
// over links are easy in. `twist`: angular velocity, and the velocity of that
// point of the link which is at Wo.
template <class T>
struct PlacedLink {
  Matrix3<T> R;       // R_WL
  Vector3<T> origin;  // of Lo
  Screw<T> joint;
  Screw<T> twist;
};

template <class T>
ARMCAL_INLINE PlacedLink<T> PlacedBase() {
  const T one = T{} + 1, zero = {};
  const Vector3<T> none = {};
  return {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}},
          none,
          {none, none},
          {none, none}};
}

template <class T>
ARMCAL_INLINE PlacedLink<T> Place(const LinkConstants& link,
                                  const SineAndCosine<T>& angle, const T& q,
                                  const T& qd, const PlacedLink<T>& parent) {
  const Matrix3<T> E = Rotation(link, angle);
  PlacedLink<T> at;
  at.R = {E * parent.R.x, E * parent.R.y, E * parent.R.z};
  at.origin = parent.origin + parent.R * link.p_PF;
  const Vector3<T> axis = at.R * link.axis, none = {};
  at.joint = {none, axis};
  if (link.rotational) at.joint = {axis, Cross(at.origin, axis)};
  if (link.has_offset) at.origin = at.origin + at.R * Offset(link, q);
  at.twist = {parent.twist.angular + at.joint.angular * qd,
              parent.twist.linear + at.joint.linear * qd};
  return at;
}

// V x S, the rate of a screw that moves with twist V.
template <class T>
ARMCAL_INLINE Screw<T> Rate(const Screw<T>& twist, const Screw<T>& screw) {
  return {
      Cross(twist.angular, screw.angular),
      Cross(twist.angular, screw.linear) + Cross(twist.linear, screw.angular)};
}

// The change of a wrench (or momentum) that is displaced by a twist.
template <class T>
ARMCAL_INLINE Wrench<T> Displaced(const Screw<T>& by, const Wrench<T>& wrench) {
  return {Cross(by.angular, wrench.couple) + Cross(by.linear, wrench.force),
          Cross(by.angular, wrench.force)};
}

// A geometric parameter's axis through a point, both moving with their link.
template <class T>
struct PlacedAxis {
  Vector3<T> axis, place;
  Vector3<T> turning, velocity;  // their rates
};

template <class T>
ARMCAL_INLINE PlacedAxis<T> Place(const GeometricParameter& parameter,
                                  const PlacedLink<T>& on) {
  PlacedAxis<T> at;
  at.axis = on.R * parameter.axis;
  at.place = on.origin + on.R * parameter.origin;
  at.turning = Cross(on.twist.angular, at.axis);
  at.velocity = on.twist.linear + Cross(on.twist.angular, at.place);
  return at;
}

// From the last link to the first: its body, then its joint; and between them
// every parameter as soon as the bodies and joints that it moves are added.
template <class AddBody, class AddJoint, class Write>
ARMCAL_INLINE void FromTipToBase(const ChainConstants& chain,
                                 const GeometryConstants& geometry,
                                 const AddBody& add_body,
                                 const AddJoint& add_joint,
                                 const Write& write) {
  const GeometricParameter* next = geometry.parameters;
  const GeometricParameter* const end = next + geometry.num_parameters;
  for (int i = chain.num_links - 1; i >= -1; --i) {
    for (; next < end && next->link == i && !next->with_body; ++next) {
      write(*next);
    }
    if (i < 0) break;
    add_body(i);
    for (; next < end && next->link == i; ++next) write(*next);
    add_joint(i);
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
