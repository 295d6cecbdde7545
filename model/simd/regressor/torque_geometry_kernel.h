#pragma once

#include "model/simd/regressor/batches.h"
#include "model/simd/regressor/forced_masses.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// How an arm's torque changes with its geometry. A parameter displaces a part
// of the arm by a twist X that is fixed on a moving link. Seen from that part,
// it stays as it is and the link moves differently: by X' its velocity and by
// X'' its acceleration, from which follow the changes of the forces on every
// particle, m (X'' at x) + 2 m w x x', the latter Coriolis' with w the angular
// part of X'. The wrench that the link feels is then displaced by X besides.

template <class T>
struct TorqueGeometryScratch {
  PlacedLink<T>* links;  // from the base on: link i at i + 1
  PlacedAcceleration<T>* accelerations;
  JointResponse<T>* joints;
};

// Column of one parameter in all rows; `to`: its place in them.
template <class T>
ARMCAL_INLINE void WriteTorque(const GeometricParameter& parameter,
                               int num_links, const ForcedMasses<T>& masses,
                               const TorqueGeometryScratch<T>& of,
                               double* const* out, long to) {
  const int first = parameter.link + 1;  // joint that is displaced
  const PlacedAcceleration<T>& acceleration = of.accelerations[first];
  const PlacedAxis<T> at = Place(parameter, of.links[first]);
  Wrench<T> change;
  if (parameter.rotation) {
    Screw<T> second;  // X''
    second.angular = acceleration.B * at.axis;
    second.linear =
        Cross(acceleration.origin + acceleration.B * at.place, at.axis) +
        Cross(at.velocity + at.velocity, at.turning) +
        Cross(at.place, second.angular);
    for (int j = first; j < num_links; ++j) {
      StoreAs(Power(second, of.joints[j].momentum) +
                  Dot(at.turning, of.joints[j].coriolis),
              out[j] + to);
    }
    const Vector3<T> w = at.turning + at.turning;
    const Screw<T> by = {at.axis, Cross(at.place, at.axis)};
    const Wrench<T> felt = MomentumOf(masses.moments, second);
    const Wrench<T> displaced = Displaced(by, masses.wrench);
    change = {felt.couple + CoriolisCouple(masses.spread, w) + displaced.couple,
              felt.force + Cross(w, masses.momentum) + displaced.force};
  } else {
    const Vector3<T> second = acceleration.B * at.axis;
    for (int j = first; j < num_links; ++j) {
      StoreAs(Dot(second, of.joints[j].momentum.force), out[j] + to);
    }
    change = {Cross(masses.moments.first, second) +
                  Cross(at.axis, masses.wrench.force),
              second * masses.moments.mass};
  }
  for (int k = 0; k < first; ++k) {
    StoreAs(Power(of.links[k + 1].joint, change), out[k] + to);
  }
}

// Columns of samples `sample` and on, as many as T has: of joint i, that of a
// parameter to out[i][place * stride + sample].
template <class T>
__attribute__((noinline)) void TorqueGeometryAt(
    const ChainConstants& chain, const GeometryConstants& geometry,
    const ChainMotion& motion, long sample, double* const* out, long stride) {
  const int n = chain.num_links;
  const TorqueGeometryScratch<T> of = {
      ARMCAL_SCRATCH(PlacedLink<T>, n + 1),
      ARMCAL_SCRATCH(PlacedAcceleration<T>, n + 1),
      ARMCAL_SCRATCH(JointResponse<T>, n)};
  auto* angles = ARMCAL_SCRATCH(SineAndCosine<T>, n);
  SineCosineOfJoints(chain, motion, sample, angles);
  const Vector3<T> none = {};
  // V', relative to free fall.
  Screw<T> change = {none, none - Constant<T>(chain.gravity)};
  of.links[0] = PlacedBase<T>();
  of.accelerations[0] = {change.linear, {none, none, none}};
  for (int i = 0; i < n; ++i) {
    const T qd = LoadAs<T>(motion.qd[i] + sample);
    const T qdd = LoadAs<T>(motion.qdd[i] + sample);
    PlacedLink<T>& link = of.links[i + 1];
    link = Place(chain.links[i], angles[i], LoadAs<T>(motion.q[i] + sample), qd,
                 of.links[i]);
    const Screw<T> rate = Rate(link.twist, link.joint);
    change.angular =
        change.angular + link.joint.angular * qdd + rate.angular * qd;
    change.linear = change.linear + link.joint.linear * qdd + rate.linear * qd;
    of.accelerations[i + 1] = {
        change.linear + Cross(link.twist.angular, link.twist.linear),
        AccelerationField(link.twist.angular, change.angular)};
  }
  ForcedMasses<T> masses = {};
  FromTipToBase(
      chain, geometry,
      [&](int i) ARMCAL_LAMBDA {
        const PlacedLink<T>& link = of.links[i + 1];
        AddBody(MomentsOf(geometry.bodies[i], link.R, link.origin), link,
                of.accelerations[i + 1], &masses);
      },
      [&](int i) ARMCAL_LAMBDA {
        of.joints[i] = ResponseOf(masses, of.links[i + 1].joint);
      },
      [&](const GeometricParameter& parameter) ARMCAL_LAMBDA {
        WriteTorque(parameter, n, masses, of, out,
                    parameter.place * stride + sample);
      });
}

inline void TorqueGeometryOfAll(const ChainConstants& chain,
                                const GeometryConstants& geometry,
                                const ChainMotion& motion, long count,
                                double* const* out, long stride) {
  const Output outputs[] = {{out, stride}};
  ForEachBatch(chain, motion, count, outputs,
               [&](const ChainMotion& of, long sample, const Output* to) {
                 TorqueGeometryAt<Lanes>(chain, geometry, of, sample,
                                         to[0].rows, to[0].stride);
               });
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
