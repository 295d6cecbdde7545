#pragma once

#include "model/simd/momentum_columns.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Columns that only model parameters have: moments of links that slide, and
// moments times unknown lengths.

// Where a sliding link's Lo is relative to Fo, and its velocity.
template <class T>
struct SlideVelocity {
  Vector3<T> offset, velocity;
};

// The momentum omega x e of a first moment along e.
template <class T>
ARMCAL_INLINE Vector3<T> CrossUnit(const Vector3<T>& omega, unsigned moment) {
  const Vector3<T> none = {};
  return none - UnitCross(moment, omega);
}

// A moment that slides, in rows 0 to i: what it has beyond the same at Fo,
// attached to the link before; in its own row the whole momentum.
template <class T>
ARMCAL_INLINE void WriteSliding(const LinkConstants& link, int i,
                                const Velocity<T>& at,
                                const SlideVelocity<T>& slide,
                                const MovingScrew<T>* joints,
                                const MomentumOutput& out) {
  const MovingScrew<T>& own_joint = joints[i];
  const Vector3<T> none = {};
  int column = 0;
  for (unsigned moment = kSlidingMass; moment <= kSlidingHz; moment *= 2) {
    if (!(link.moments & moment)) continue;
    Vector3<T> own, weight, own_weight;
    Wrench<T> momentum;
    if (moment == kSlidingMass) {
      own = at.origin + slide.velocity;
      momentum = {Cross(slide.offset, own), slide.velocity};
      weight = Cross(slide.offset, at.gravity);
      own_weight = at.gravity;
    } else {
      own = CrossUnit(at.omega, moment);
      momentum = {UnitCross(moment, slide.velocity) + Cross(slide.offset, own),
                  none};
      weight = own_weight = none;
    }
    out.Row(link, i, column)
        .Write(Dot(own_joint.screw.linear, own),
               Dot(own_joint.change.linear, own) +
                   Dot(own_joint.screw.linear, own_weight));
    for (int k = 0; k < i; ++k) {
      out.Row(link, k, column)
          .Write(Power(joints[k].screw, momentum),
                 Power(joints[k].change, momentum) +
                     Dot(joints[k].screw.angular, weight));
    }
    ++column;
  }
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

// Moments times lengths, in rows 0 to i. Only couples: others for joints before
// the length than for those behind it, whose own velocity it changes.
template <class T>
ARMCAL_INLINE void WriteLengths(const ChainConstants& chain, int i,
                                const LengthVelocity<T>* lengths,
                                const Velocity<T>& at,
                                const SlideVelocity<T>& slide,
                                const MovingScrew<T>* joints,
                                const MomentumOutput& out) {
  const LinkConstants& link = chain.links[i];
  const Screw<T>&own = joints[i].screw, &own_change = joints[i].change;
  for (int c = 0; c < link.num_length_columns; ++c) {
    const LengthColumn& column = link.length_columns[c];
    const LengthVelocity<T>& length = lengths[column.length];
    const Vector3<T> linear =
        link.rotational ? CrossUnit(at.omega, column.moment) : slide.velocity;
    const Vector3<T> behind = link.rotational
                                  ? UnitCross(column.moment, length.velocity)
                                  : Cross(slide.offset, length.velocity);
    const Vector3<T> before = behind + Cross(length.unit, linear);
    const Vector3<T> change = Cross(linear, length.velocity);
    MomentumWriter to = out.Row(link, i, link.num_moments + c);
    if (link.rotational) {
      to.Write(Dot(own.angular, behind),
               Dot(own_change.angular, behind) + Dot(own.angular, change));
    } else {
      to.Write(Dot(own.linear, length.velocity),
               Dot(own_change.linear, length.velocity));
    }
    const int last_before = chain.lengths[column.length].link;
    for (int k = 0; k < i; ++k) {
      const Vector3<T>&z = joints[k].screw.angular,
            &rate = joints[k].change.angular;
      MomentumWriter row = out.Row(link, k, link.num_moments + c);
      if (k <= last_before) {
        row.Write(Dot(z, before), Dot(rate, before));
      } else {
        row.Write(Dot(z, behind), Dot(rate, behind) + Dot(z, change));
      }
    }
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
