#pragma once

#include "model/simd/regressor/differential_columns.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Columns that only model parameters have: moments of links that slide, and
// moments times unknown lengths.

// Column of B along a first moment.
template <class T>
ARMCAL_INLINE Vector3<T> UnitColumn(unsigned moment, const Matrix3<T>& B) {
  if (moment & (kHx | kSlidingHx)) return Column(B, 0);
  if (moment & (kHy | kSlidingHy)) return Column(B, 1);
  return Column(B, 2);
}

// A unit of an unknown length in the present link's frame, and the acceleration
// that it gives to what lies behind it.
template <class T>
struct LengthAcceleration {
  Vector3<T> unit, acceleration;
};

// From P to L; `at` is still of P.
template <class T>
ARMCAL_INLINE void EnterLink(const ChainConstants& chain, int i,
                             const Matrix3<T>& E, const Acceleration<T>& at,
                             LengthAcceleration<T>* lengths) {
  for (int u = 0; u < chain.num_lengths; ++u) {
    const LengthConstants& length = chain.lengths[u];
    if (length.link + 1 == i) {
      lengths[u] = {Column(E, length.component),
                    E * Column(at.B, length.component)};
    } else if (length.link + 1 < i) {
      lengths[u] = {E * lengths[u].unit, E * lengths[u].acceleration};
    }
  }
}

// Link i's length column c, in rows 0 to i. It needs no force: only a couple,
// another one `before` the length, for joints that move it, than `behind`.
template <class T>
ARMCAL_INLINE void WriteLength(const ChainConstants& chain, int i, int c,
                               const Vector3<T>& before,
                               const Vector3<T>& behind, const T& own,
                               const Screw<T>* screws, double* const* out,
                               long offset, long stride) {
  const LinkConstants& link = chain.links[i];
  const int last_before = chain.lengths[link.length_columns[c].length].link;
  for (int k = 0; k <= i; ++k) {
    double* to =
        out[k] + offset + PlacesOfRow(link, k)[link.num_moments + c] * stride;
    StoreAs(k == i ? own
                   : Dot(screws[k].angular, k <= last_before ? before : behind),
            to);
  }
}

// All length columns of a revolute joint's link, in rows 0 to i.
template <class T>
ARMCAL_INLINE void WriteLengths(const ChainConstants& chain, int i,
                                const Acceleration<T>& at,
                                const LengthAcceleration<T>* lengths,
                                const Screw<T>* screws, double* const* out,
                                long offset, long stride) {
  const LinkConstants& link = chain.links[i];
  for (int c = 0; c < link.num_length_columns; ++c) {
    const LengthColumn& column = link.length_columns[c];
    const LengthAcceleration<T>& length = lengths[column.length];
    const Vector3<T> behind = UnitCross(column.moment, length.acceleration);
    const Vector3<T> force = UnitColumn(column.moment, at.B);
    WriteLength(chain, i, c, behind + Cross(length.unit, force), behind,
                Dot(screws[i].angular, behind), screws, out, offset, stride);
  }
}

// Where a sliding link's Lo is relative to Fo, and its acceleration.
template <class T>
struct Slide {
  Vector3<T> offset, acceleration;
};

// All columns of a link that slides, in rows 0 to i: what it needs beyond the
// same at Fo, attached to the link before; in its own row the whole force.
template <class T>
ARMCAL_INLINE void WriteSliding(const ChainConstants& chain, int i,
                                const Acceleration<T>& at,
                                const Slide<T>& slide,
                                const LengthAcceleration<T>* lengths,
                                const Screw<T>* screws, double* const* out,
                                long offset, long stride) {
  const LinkConstants& link = chain.links[i];
  const auto row = [&](int k, int column) ARMCAL_LAMBDA {
    return RowWriter<1, false>{
        {out[k] + offset}, stride, PlacesOfRow(link, k) + column};
  };
  int column = 0;
  for (unsigned moment = kSlidingMass; moment <= kSlidingHz; moment *= 2) {
    Wrench<T> wrench;
    Vector3<T> own;
    if (moment == kSlidingMass) {
      own = at.origin + slide.acceleration;
      wrench = {Cross(slide.offset, own), slide.acceleration};
    } else {
      own = UnitColumn(moment, at.B);
      wrench.couple =
          UnitCross(moment, slide.acceleration) + Cross(slide.offset, own);
      wrench.force = own - own;
    }
    for (int k = 0; k < i; ++k) {
      row(k, column).Write(Power(screws[k], wrench));
    }
    row(i, column).Write(Dot(screws[i].linear, own));
    ++column;
  }
  for (int c = 0; c < link.num_length_columns; ++c) {
    const LengthAcceleration<T>& length =
        lengths[link.length_columns[c].length];
    const Vector3<T> behind = Cross(slide.offset, length.acceleration);
    WriteLength(chain, i, c, behind + Cross(length.unit, slide.acceleration),
                behind, Dot(screws[i].linear, length.acceleration), screws, out,
                offset, stride);
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET
