#pragma once

#include "model/simd/regressor/momentum_columns.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Columns that only model parameters have: moments of links that slide, and
// moments times unknown lengths.

// The momentum omega x e of a first moment along e.
template <class T>
ARMCAL_INLINE Vector3<T> CrossUnit(const Vector3<T>& omega, unsigned moment) {
  const Vector3<T> none = {};
  return none - UnitCross(moment, omega);
}

// A unit of an unknown length in the present link's frame, and the velocity
// that it gives to what lies behind it.
template <class T>
struct LengthVelocity {
  Vector3<T> unit, velocity;
};

// From P to L; `omega` is still of P.
template <class T>
ARMCAL_INLINE void EnterLink(const ChainConstants& chain, int i,
                             const Matrix3<T>& E, const Vector3<T>& omega,
                             LengthVelocity<T>* lengths) {
  for (int u = 0; u < chain.num_lengths; ++u) {
    const LengthConstants& length = chain.lengths[u];
    if (length.link + 1 == i) {
      lengths[u].unit = Column(E, length.component);
      lengths[u].velocity = Cross(E * omega, lengths[u].unit);
    } else if (length.link + 1 < i) {
      lengths[u] = {E * lengths[u].unit, E * lengths[u].velocity};
    }
  }
}

// Link i's length column c, in rows 0 to i; `linear` is the momentum of the
// unit itself, whose couple is another one for joints before the length, which
// move it, than for those behind, whose velocity it changes.
template <class T>
ARMCAL_INLINE void WriteLength(const ChainConstants& chain, int i, int c,
                               const Vector3<T>& linear,
                               const Vector3<T>& behind,
                               const LengthVelocity<T>* lengths,
                               const MovingScrew<T>* joints,
                               const MomentumOutput& out) {
  const LinkConstants& link = chain.links[i];
  const int u = link.length_columns[c].length;
  const Vector3<T> before = behind + Cross(lengths[u].unit, linear);
  const Vector3<T> change = Cross(linear, lengths[u].velocity);
  for (int k = 0; k <= i; ++k) {
    const Screw<T>&S = joints[k].screw, &C = joints[k].change;
    auto row = out.Row<true>(link, k, link.num_moments + c);
    if (k <= chain.lengths[u].link) {
      row.Write(Dot(S.angular, before), Dot(C.angular, before));
    } else if (k < i || link.rotational) {
      row.Write(Dot(S.angular, behind),
                Dot(C.angular, behind) + Dot(S.angular, change));
    } else {
      row.Write(Dot(S.linear, lengths[u].velocity),
                Dot(C.linear, lengths[u].velocity));
    }
  }
}

// All length columns of a revolute joint's link, in rows 0 to i.
template <class T>
ARMCAL_INLINE void WriteLengths(const ChainConstants& chain, int i,
                                const Velocity<T>& at,
                                const LengthVelocity<T>* lengths,
                                const MovingScrew<T>* joints,
                                const MomentumOutput& out) {
  const LinkConstants& link = chain.links[i];
  for (int c = 0; c < link.num_length_columns; ++c) {
    const LengthColumn& column = link.length_columns[c];
    WriteLength(chain, i, c, CrossUnit(at.omega, column.moment),
                UnitCross(column.moment, lengths[column.length].velocity),
                lengths, joints, out);
  }
}

// Where a sliding link's Lo is relative to Fo, and its velocity.
template <class T>
struct SlideVelocity {
  Vector3<T> offset, velocity;
};

// All columns of a link that slides, in rows 0 to i: what it has beyond the
// same at Fo, attached to the link before; in its own row the whole momentum.
template <class T>
ARMCAL_INLINE void WriteSliding(const ChainConstants& chain, int i,
                                const Velocity<T>& at,
                                const SlideVelocity<T>& slide,
                                const LengthVelocity<T>* lengths,
                                const MovingScrew<T>* joints,
                                const MomentumOutput& out) {
  const LinkConstants& link = chain.links[i];
  const Vector3<T> none = {};
  int column = 0;
  for (unsigned moment = kSlidingMass; moment <= kSlidingHz; moment *= 2) {
    Vector3<T> own = at.origin + slide.velocity;
    Wrench<T> momentum = {Cross(slide.offset, own), slide.velocity};
    Vector3<T> weight = Cross(slide.offset, at.gravity);
    Vector3<T> own_weight = at.gravity;
    if (moment != kSlidingMass) {
      own = CrossUnit(at.omega, moment);
      momentum = {UnitCross(moment, slide.velocity) + Cross(slide.offset, own),
                  none};
      weight = own_weight = none;
    }
    for (int k = 0; k < i; ++k) {
      const MovingScrew<T>& joint = joints[k];
      out.Row<false>(link, k, column)
          .Write(
              Power(joint.screw, momentum),
              Power(joint.change, momentum) + Dot(joint.screw.angular, weight));
    }
    out.Row<false>(link, i, column)
        .Write(Dot(joints[i].screw.linear, own),
               Dot(joints[i].change.linear, own) +
                   Dot(joints[i].screw.linear, own_weight));
    ++column;
  }
  for (int c = 0; c < link.num_length_columns; ++c) {
    const LengthVelocity<T>& length = lengths[link.length_columns[c].length];
    WriteLength(chain, i, c, slide.velocity,
                Cross(slide.offset, length.velocity), lengths, joints, out);
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
