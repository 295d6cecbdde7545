#pragma once

#include "model/simd/batches.h"
#include "model/simd/momentum_columns.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// One link's columns.
template <class T>
struct MomentumColumns {
  Vector3<T>* couples;
  MomentumWrench<T>* wrenches;
  LengthMomentum<T>* lengths;
};

// A joint's screw S and V x S, with V the twist of its link: dL/dqd is S . h,
// and dL/dq is (V x S) . h + S . (wrench of gravity).
template <class T>
struct MovingScrew {
  Screw<T> screw, change;
};

// Where the sample's rows begin.
struct MomentumRow {
  double *P, *D;
  long stride;
};

template <class T>
ARMCAL_INLINE void Write(const MomentumRow& row, int place, const T& P,
                         const T& D) {
  StoreAs(P, row.P + place * row.stride);
  StoreAs(D, row.D + place * row.stride);
}

// Row k of columns without lengths.
template <class T>
ARMCAL_INLINE void WriteRow(const LinkConstants& link, int k,
                            const MovingScrew<T>& joint, const Velocity<T>& at,
                            const MomentumColumns<T>& columns,
                            const MomentumRow& row) {
  const int* place = PlacesOfRow(link, k);
  for (int c = 0; c < link.num_couples; ++c) {
    const Vector3<T>& couple = columns.couples[c];
    Write(row, *place++, Dot(joint.screw.angular, couple),
          Dot(joint.change.angular, couple));
  }
  const MomentumWrench<T>* wrench = columns.wrenches;
  if (link.moments & kMass) {
    const Vector3<T>& force = (wrench++)->momentum.force;
    Write(
        row, *place++, Dot(joint.screw.linear, force),
        Dot(joint.change.linear, force) + Dot(joint.screw.linear, at.gravity));
  }
  for (; wrench < columns.wrenches + link.num_wrenches; ++wrench) {
    Write(row, *place++, Power(joint.screw, wrench->momentum),
          Power(joint.change, wrench->momentum) +
              Dot(joint.screw.angular, wrench->gravity_couple));
  }
}

template <class T>
ARMCAL_INLINE void WriteLengths(const ChainConstants& chain,
                                const LinkConstants& link, int k,
                                const MovingScrew<T>& joint,
                                const MomentumColumns<T>& columns,
                                const MomentumRow& row) {
  const int* place =
      PlacesOfRow(link, k) + link.num_couples + link.num_wrenches;
  const Vector3<T>&z = joint.screw.angular, &rate = joint.change.angular;
  for (int c = 0; c < link.num_length_columns; ++c) {
    const LengthMomentum<T>& m = columns.lengths[c];
    if (k <= chain.lengths[link.length_columns[c].length].link) {
      Write(row, *place++, Dot(z, m.before), Dot(rate, m.before));
    } else {
      Write(row, *place++, Dot(z, m.behind),
            Dot(rate, m.behind) + Dot(z, m.change));
    }
  }
}

// The link's own row; of a sliding mass it has gravity's force.
template <class T>
ARMCAL_INLINE void WriteOwnRow(const LinkConstants& link, int i,
                               const MovingScrew<T>& joint,
                               const Velocity<T>& at,
                               const MomentumColumns<T>& columns,
                               const MomentumRow& row) {
  WriteRow(link, i, joint, at, columns, row);
  const int* place = PlacesOfRow(link, i) + link.num_couples;
  if (link.moments & kSlidingMass) {
    const Vector3<T>& force = columns.wrenches[0].momentum.force;
    Write(
        row, *place, Dot(joint.screw.linear, force),
        Dot(joint.change.linear, force) + Dot(joint.screw.linear, at.gravity));
  }
  place += link.num_wrenches;
  for (int c = 0; c < link.num_length_columns; ++c) {
    Write(row, *place++, columns.lengths[c].own_P, columns.lengths[c].own_D);
  }
}

// Of the link's own joint at Fo; the second is V x S.
template <class T>
ARMCAL_INLINE MovingScrew<T> OwnMovingScrew(const LinkConstants& link,
                                            const Velocity<T>& at) {
  MovingScrew<T> own = {OwnScrew<T>(link), {}};
  const Vector3<T> rate = Cross(at.omega, link.axis);
  if (link.rotational) {
    own.change = {rate, Cross(at.origin, link.axis)};
  } else {
    own.change.linear = rate;
  }
  return own;
}

// P and D of samples `sample` and on, as many as T has: see BatchRegressor.
template <class T>
__attribute__((noinline)) void MomentumAt(const ChainConstants& chain,
                                          const ChainMotion& motion,
                                          long sample, double* const* P,
                                          double* const* D, long stride) {
  auto* joints = ARMCAL_SCRATCH(MovingScrew<T>, chain.num_links);
  auto* lengths = ARMCAL_SCRATCH(LengthVelocity<T>, chain.num_lengths);
  const MomentumColumns<T> columns = {
      ARMCAL_SCRATCH(Vector3<T>, chain.most_couples),
      ARMCAL_SCRATCH(MomentumWrench<T>, chain.most_wrenches),
      ARMCAL_SCRATCH(LengthMomentum<T>, chain.most_length_columns)};
  Velocity<T> at = {{}, {}, Constant<T>(chain.gravity)};
  for (int i = 0; i < chain.num_links; ++i) {
    const LinkConstants& link = chain.links[i];
    const T q = LoadAs<T>(motion.q[i] + sample);
    const T qd = LoadAs<T>(motion.qd[i] + sample);
    const Matrix3<T> E = Rotation(link, q);
    EnterLink(chain, i, E, at.omega, lengths);
    EnterLink(link, E, &at);
    for (int k = 0; k < i; ++k) {
      EnterLink(link, E, &joints[k].screw);
      EnterLink(link, E, &joints[k].change);
    }
    const Vector3<T> way = Times(link.axis, qd);
    if (link.rotational) at.omega = at.omega + way;
    joints[i] = OwnMovingScrew(link, at);

    const Vector3<T> offset = Offset(link, q);
    Vector3<T> offset_velocity = Cross(at.omega, offset);
    if (!link.rotational) offset_velocity = offset_velocity + way;
    const auto leave_joint = [&] {
      at.origin = at.origin + offset_velocity;
      for (int k = 0; k <= i; ++k) {
        Shift(offset, &joints[k].screw);
        Shift(offset, &joints[k].change);
      }
    };
    if (link.has_offset && !link.regrouped) leave_joint();
    SetMomentumCouples(link.moments, at.omega, columns.couples);
    SetMomentumWrenches(link.moments, at, offset_velocity, columns.wrenches);
    for (int c = 0; c < link.num_length_columns; ++c) {
      const LengthColumn& column = link.length_columns[c];
      columns.lengths[c] =
          MomentumOf(link, column.moment, lengths[column.length], at, offset,
                     offset_velocity);
    }
    const auto row = [&](int k) {
      return MomentumRow{P[k] + sample, D[k] + sample, stride};
    };
    WriteOwnRow(link, i, joints[i], at, columns, row(i));
    if (link.regrouped) {
      RegroupMomentum(link, at, offset, offset_velocity, qd, columns.couples,
                      columns.wrenches);
    }
    for (int k = 0; k < i; ++k) {
      WriteRow(link, k, joints[k], at, columns, row(k));
      WriteLengths(chain, link, k, joints[k], columns, row(k));
    }
    if (link.has_offset && link.regrouped) leave_joint();
  }
}

inline void MomentumOfAll(const ChainConstants& chain,
                          const ChainMotion& motion, long count,
                          double* const* P, double* const* D, long stride) {
  const Output outputs[] = {{P, stride}, {D, stride}};
  ForEachBatch(chain, motion, count, outputs,
               [&](const ChainMotion& of, long sample, const Output* to) {
                 MomentumAt<Lanes>(chain, of, sample, to[0].rows, to[1].rows,
                                   to[0].stride);
               });
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
