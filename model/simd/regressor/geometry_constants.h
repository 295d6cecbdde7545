#pragma once

namespace armcal::simd {

// A geometric parameter: it turns what lies behind it about an axis through
// `origin`, or shifts it along the axis, both in the frame L of `link` (-1: the
// base), with which they move. Behind it are all further links and their
// joints and, where it lies between the link's own joint and its frame, that
// link's body.
struct GeometricParameter {
  int link;
  bool with_body;
  bool rotation;
  double axis[3], origin[3];
  int place;  // of its column
};

// A link's inertia by its particles, of mass m at x from Lo, in L.
struct BodyMoments {
  double mass;       // kg
  double first[3];   // kg m, sum m x
  double second[6];  // kg m^2, sum m x x': xx, xy, xz, yy, yz, zz
};

// In the order in which the kernels need them: from the last link's parameters
// to the base's, of one link those with its body last.
struct GeometryConstants {
  int num_parameters;
  const GeometricParameter* parameters;
  const BodyMoments* bodies;  // one per link
};

}  // namespace armcal::simd
