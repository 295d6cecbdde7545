#pragma once

#include "model/simd/regressor/batches.h"
#include "model/simd/regressor/mass_moments.h"
#include "model/simd/regressor/momentum_columns.h"
#include "model/simd/regressor/placed_link.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// How an arm's dL/dqd (P) and dL/dq (D) change with its geometry. A parameter
// displaces a part of the arm by a twist X that is fixed on a moving link. Seen
// from that part, it stays as it is, but moves by X' more and gravity is turned
// back; its momentum and weight are then displaced by X besides.

// Of all masses behind a cut through the arm.
template <class T>
struct MovingMasses {
  MassMoments<T> moments;
  Wrench<T> momentum;  // angular, linear
};

template <class T>
ARMCAL_INLINE void AddBody(const MassMoments<T>& body,
                           const PlacedLink<T>& link, MovingMasses<T>* sums) {
  const Wrench<T> h = MomentumOf(body, link.twist);
  sums->moments = sums->moments + body;
  sums->momentum = {sums->momentum.couple + h.couple,
                    sums->momentum.force + h.force};
}

// How a joint responds when its masses move differently: P by the power of
// `momentum` with X', D that of `change`, and that of the turned gravity with
// the linear part of `momentum`.
template <class T>
struct MovedJoint {
  Screw<T> rate;  // of its screw
  Wrench<T> momentum, change;
};

template <class T>
ARMCAL_INLINE void SetResponse(const MovingMasses<T>& masses,
                               const Screw<T>& joint, MovedJoint<T>* to) {
  const Wrench<T> rate = MomentumOf(masses.moments, to->rate);
  const Wrench<T>& h = masses.momentum;
  to->momentum = MomentumOf(masses.moments, joint);
  to->change = {rate.couple + Cross(joint.angular, h.couple) +
                    Cross(joint.linear, h.force),
                rate.force + Cross(joint.angular, h.force)};
}

template <class T>
struct MomentumGeometryScratch {
  PlacedLink<T>* links;  // from the base on: link i at i + 1
  MovedJoint<T>* joints;
  Vector3<T> gravity;
};

template <class T>
ARMCAL_INLINE void WriteBoth(const T& P, const T& D, int row, long to,
                             const MomentumOutput& out) {
  StoreAs(P, out.P[row] + to);
  StoreAs(D, out.D[row] + to);
}

// Columns of one parameter in all rows.
template <class T>
ARMCAL_INLINE void WriteMomentum(const GeometricParameter& parameter,
                                 int num_links, const MovingMasses<T>& masses,
                                 const MomentumGeometryScratch<T>& of,
                                 const MomentumOutput& out) {
  const int first = parameter.link + 1;  // joint that is displaced
  const long to = out.offset + parameter.place * out.stride;
  const PlacedAxis<T> at = Place(parameter, of.links[first]);
  const MassMoments<T>& moments = masses.moments;
  Wrench<T> change;
  Vector3<T> weight;  // change of its couple
  if (parameter.rotation) {
    const Screw<T> by = {at.axis, Cross(at.place, at.axis)};
    const Screw<T> rate = {
        at.turning, Cross(at.velocity, at.axis) + Cross(at.place, at.turning)};
    const Vector3<T> gravity = Cross(of.gravity, at.axis);
    for (int j = first; j < num_links; ++j) {
      const MovedJoint<T>& joint = of.joints[j];
      WriteBoth(Power(rate, joint.momentum),
                Power(rate, joint.change) + Dot(gravity, joint.momentum.force),
                j, to, out);
    }
    const Wrench<T> more = MomentumOf(moments, rate);
    const Wrench<T> displaced = Displaced(by, masses.momentum);
    change = {more.couple + displaced.couple, more.force + displaced.force};
    weight = Cross(Cross(at.axis, moments.first) + by.linear * moments.mass,
                   of.gravity);
  } else {
    for (int j = first; j < num_links; ++j) {
      const MovedJoint<T>& joint = of.joints[j];
      WriteBoth(Dot(at.turning, joint.momentum.force),
                Dot(at.turning, joint.change.force), j, to, out);
    }
    change = {Cross(moments.first, at.turning) +
                  Cross(at.axis, masses.momentum.force),
              at.turning * moments.mass};
    weight = Cross(at.axis * moments.mass, of.gravity);
  }
  for (int k = 0; k < first; ++k) {
    const Screw<T>& joint = of.links[k + 1].joint;
    WriteBoth(Power(joint, change),
              Power(of.joints[k].rate, change) + Dot(joint.angular, weight), k,
              to, out);
  }
}

// Columns of samples `sample` and on, as many as T has: of joint i, those of a
// parameter to P[i][place * stride + sample] and to D's.
template <class T>
__attribute__((noinline)) void MomentumGeometryAt(
    const ChainConstants& chain, const GeometryConstants& geometry,
    const ChainMotion& motion, long sample, double* const* P, double* const* D,
    long stride) {
  const int n = chain.num_links;
  const MomentumOutput out = {P, D, sample, stride};
  const MomentumGeometryScratch<T> of = {ARMCAL_SCRATCH(PlacedLink<T>, n + 1),
                                         ARMCAL_SCRATCH(MovedJoint<T>, n),
                                         Constant<T>(chain.gravity)};
  auto* angles = ARMCAL_SCRATCH(SineAndCosine<T>, n);
  SineCosineOfJoints(chain, motion, sample, angles);
  of.links[0] = PlacedBase<T>();
  for (int i = 0; i < n; ++i) {
    of.links[i + 1] =
        Place(chain.links[i], angles[i], LoadAs<T>(motion.q[i] + sample),
              LoadAs<T>(motion.qd[i] + sample), of.links[i]);
    of.joints[i].rate = Rate(of.links[i + 1].twist, of.links[i + 1].joint);
  }
  MovingMasses<T> masses = {};
  FromTipToBase(
      chain, geometry,
      [&](int i) ARMCAL_LAMBDA {
        const PlacedLink<T>& link = of.links[i + 1];
        AddBody(MomentsOf(geometry.bodies[i], link.R, link.origin), link,
                &masses);
      },
      [&](int i) ARMCAL_LAMBDA {
        SetResponse(masses, of.links[i + 1].joint, &of.joints[i]);
      },
      [&](const GeometricParameter& parameter)
          ARMCAL_LAMBDA { WriteMomentum(parameter, n, masses, of, out); });
}

inline void MomentumGeometryOfAll(const ChainConstants& chain,
                                  const GeometryConstants& geometry,
                                  const ChainMotion& motion, long count,
                                  double* const* P, double* const* D,
                                  long stride) {
  const Output outputs[] = {{P, stride}, {D, stride}};
  ForEachBatch(chain, motion, count, outputs,
               [&](const ChainMotion& of, long sample, const Output* to) {
                 MomentumGeometryAt<Lanes>(chain, geometry, of, sample,
                                           to[0].rows, to[1].rows,
                                           to[0].stride);
               });
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
