#pragma once

#include "model/simd/regressor/batches.h"
#include "model/simd/regressor/link_acceleration.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// What link inertia V (m, hx, hy, hz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz about Lo in
// L) needs to move as its frame does.
template <class T>
ARMCAL_INLINE Wrench<T> LinkWrench(const double* V, const Acceleration<T>& at) {
  const auto inertia_times = [&](const Vector3<T>& a) {
    return Vector3<T>{V[4] * a.x + V[5] * a.y + V[7] * a.z,
                      V[5] * a.x + V[6] * a.y + V[8] * a.z,
                      V[7] * a.x + V[8] * a.y + V[9] * a.z};
  };
  const Vector3<T> none = {};
  return {inertia_times(at.alpha) + Cross(at.omega, inertia_times(at.omega)) +
              (none - Cross(at.origin, V + 1)),
          Times(V[0], at.origin) + at.B * (V + 1)};
}

// One link on the way out: how its frame lies in P, and its wrench.
template <class T>
struct LinkState {
  Matrix3<T> E;  // R_LP
  Vector3<T> offset;
  Wrench<T> wrench;  // about Lo, in L
};

// Recursive Newton-Euler for samples `sample` and on, as many as T has: torques
// of joint j to tau[j].
template <class T>
__attribute__((noinline)) void NewtonEulerAt(const ChainConstants& chain,
                                             const double* inertia,
                                             const ChainMotion& motion,
                                             long sample, double* const* tau) {
  auto* links = ARMCAL_SCRATCH(LinkState<T>, chain.num_links);
  auto* angles = ARMCAL_SCRATCH(SineAndCosine<T>, chain.num_links);
  SineCosineOfJoints(chain, motion, sample, angles);
  Acceleration<T> at = AtRest<T>(chain);
  for (int i = 0; i < chain.num_links; ++i) {
    const LinkConstants& link = chain.links[i];
    LinkState<T>& state = links[i];
    const T q = LoadAs<T>(motion.q[i] + sample);
    const T qd = LoadAs<T>(motion.qd[i] + sample);
    const T qdd = LoadAs<T>(motion.qdd[i] + sample);
    state.E = Rotation(link, angles[i]);
    EnterLink(link, state.E, &at);
    AddJoint(link, qd, qdd, &at);
    state.offset = Offset(link, q);
    if (link.has_offset) {
      at.origin =
          at.origin + OffsetAcceleration(link, state.offset, qd, qdd, at);
    }
    state.wrench = LinkWrench(inertia + 10 * i, at);
  }
  for (int i = chain.num_links - 1; i >= 0; --i) {
    const LinkConstants& link = chain.links[i];
    LinkState<T>& state = links[i];
    Wrench<T>& wrench = state.wrench;
    if (link.has_offset) {  // to Fo
      wrench.couple = wrench.couple + Cross(state.offset, wrench.force);
    }
    StoreAs(Dot(Constant<T>(link.axis),
                link.rotational ? wrench.couple : wrench.force),
            tau[i] + sample);
    if (i == 0) break;
    Wrench<T>& parent = links[i - 1].wrench;
    const Vector3<T> force = TransposedTimes(state.E, wrench.force);
    const Vector3<T> none = {};
    parent.force = parent.force + force;
    parent.couple = parent.couple + TransposedTimes(state.E, wrench.couple) +
                    (none - Cross(force, link.p_PF));
  }
}

inline void NewtonEulerOfAll(const ChainConstants& chain, const double* inertia,
                             const ChainMotion& motion, long count,
                             double* const* tau) {
  const Output outputs[] = {{tau, 0}};
  ForEachBatch(chain, motion, count, outputs,
               [&](const ChainMotion& of, long sample, const Output* to) {
                 NewtonEulerAt<Lanes>(chain, inertia, of, sample, to[0].rows);
               });
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
