#pragma once

#include "model/simd/batches.h"
#include "model/simd/differential_columns.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// One link's columns.
template <class T>
struct DifferentialColumns {
  Vector3<T>* couples;
  Wrench<T>* wrenches;
  LengthCouples<T>* length_couples;
};

// Row k of them, to `row`.
template <class T>
ARMCAL_INLINE void WriteRow(const ChainConstants& chain,
                            const LinkConstants& link, int k,
                            const Screw<T>& screw,
                            const DifferentialColumns<T>& columns, double* row,
                            long stride) {
  const int* place = PlacesOfRow(link, k);
  for (int c = 0; c < link.num_couples; ++c) {
    StoreAs(Dot(screw.angular, columns.couples[c]), row + *place++ * stride);
  }
  for (int c = 0; c < link.num_wrenches; ++c) {
    StoreAs(Power(screw, columns.wrenches[c]), row + *place++ * stride);
  }
  for (int c = 0; c < link.num_length_columns; ++c) {
    const int u = link.length_columns[c].length;
    const LengthCouples<T>& couples = columns.length_couples[c];
    const T value =
        Dot(screw.angular,
            k <= chain.lengths[u].link ? couples.before : couples.behind);
    StoreAs(value, row + *place++ * stride);
  }
}

// The link's own row, where its screw is the unit vector along an axis of L.
template <class T>
ARMCAL_INLINE void WriteOwnRow(const LinkConstants& link, int k,
                               const DifferentialColumns<T>& columns,
                               double* row, long stride) {
  const int* place = PlacesOfRow(link, k);
  const auto write = [&](const Vector3<T>& couple) {
    const T& along = link.axis_index == 0   ? couple.x
                     : link.axis_index == 1 ? couple.y
                                            : couple.z;
    StoreAs(along * link.axis_sign, row + *place++ * stride);
  };
  for (int c = 0; c < link.num_couples; ++c) write(columns.couples[c]);
  for (int c = 0; c < link.num_wrenches; ++c) write(columns.wrenches[c].couple);
}

template <class T>
ARMCAL_INLINE void WriteOwnLengths(const LinkConstants& link, int k,
                                   const DifferentialColumns<T>& columns,
                                   double* row, long stride) {
  const int* place =
      PlacesOfRow(link, k) + link.num_couples + link.num_wrenches;
  for (int c = 0; c < link.num_length_columns; ++c) {
    StoreAs(columns.length_couples[c].own, row + *place++ * stride);
  }
}

// U of samples `sample` and on, as many as T has: see BatchRegressor.
template <class T>
__attribute__((noinline)) void DifferentialAt(const ChainConstants& chain,
                                              const ChainMotion& motion,
                                              long sample, double* const* out,
                                              long stride) {
  auto* screws = ARMCAL_SCRATCH(Screw<T>, chain.num_links);
  auto* lengths = ARMCAL_SCRATCH(LengthAcceleration<T>, chain.num_lengths);
  const DifferentialColumns<T> columns = {
      ARMCAL_SCRATCH(Vector3<T>, chain.most_couples),
      ARMCAL_SCRATCH(Wrench<T>, chain.most_wrenches),
      ARMCAL_SCRATCH(LengthCouples<T>, chain.most_length_columns)};
  Acceleration<T> at = AtRest<T>(chain);
  for (int i = 0; i < chain.num_links; ++i) {
    const LinkConstants& link = chain.links[i];
    const T q = LoadAs<T>(motion.q[i] + sample);
    const T qd = LoadAs<T>(motion.qd[i] + sample);
    const T qdd = LoadAs<T>(motion.qdd[i] + sample);
    const Matrix3<T> E = Rotation(link, q);
    EnterLink(chain, i, E, at, lengths);
    EnterLink(link, E, &at);
    AddJoint(link, qd, qdd, &at);
    for (int k = 0; k < i; ++k) EnterLink(link, E, &screws[k]);
    screws[i] = OwnScrew<T>(link);

    const Vector3<T> offset = Offset(link, q);
    const Vector3<T> offset_acceleration =
        OffsetAcceleration(link, offset, qd, qdd, at);
    const auto leave_joint = [&] {
      at.origin = at.origin + offset_acceleration;
      for (int k = 0; k <= i; ++k) Shift(offset, &screws[k]);
    };
    if (link.has_offset && !link.regrouped) leave_joint();
    SetCouples(link.moments, at, columns.couples);
    SetWrenches(link.moments, at, offset_acceleration, columns.wrenches);
    for (int c = 0; c < link.num_length_columns; ++c) {
      const LengthColumn& column = link.length_columns[c];
      columns.length_couples[c] =
          CouplesOf(link, column.moment, lengths[column.length], at, offset,
                    offset_acceleration);
    }
    if (link.axis_index >= 0) {
      WriteOwnRow(link, i, columns, out[i] + sample, stride);
    } else {
      WriteRow(chain, link, i, screws[i], columns, out[i] + sample, stride);
    }
    WriteOwnLengths(link, i, columns, out[i] + sample, stride);
    if (link.regrouped) {
      Regroup(link, at, offset, offset_acceleration, qd, qdd, columns.couples,
              columns.wrenches);
    }
    for (int k = 0; k < i; ++k) {
      WriteRow(chain, link, k, screws[k], columns, out[k] + sample, stride);
    }
    if (link.has_offset && link.regrouped) leave_joint();
  }
}

inline void DifferentialOfAll(const ChainConstants& chain,
                              const ChainMotion& motion, long count,
                              double* const* out, long stride) {
  const Output outputs[] = {{out, stride}};
  ForEachBatch(chain, motion, count, outputs,
               [&](const ChainMotion& of, long sample, const Output* to) {
                 DifferentialAt<Lanes>(chain, of, sample, to[0].rows,
                                       to[0].stride);
               });
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
