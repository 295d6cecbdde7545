#pragma once

namespace armcal::simd {

// A chain of links and the columns of its regressor as the kernels read them
// (model/dynamics/regressor_plan.h makes them). Each link has a frame L, in
// which its columns are computed; frames P, F and M are those of
// model/robot/robot.h.

// What a column is the coefficient of: a moment of the link's inertia about Lo
// in L. Some are the paper's: rows before the link's own have that moment less
// the same inertia attached to the link before, at q = 0; those of a prismatic
// joint are about Fo, which does not slide. Bits of LinkConstants::moments, in
// whose order columns are written.
enum LinkMoment : unsigned {
  kIxx = 1 << 0,
  kIxy = 1 << 1,
  kIyy = 1 << 2,
  kIxz = 1 << 3,
  kIyz = 1 << 4,
  kIzz = 1 << 5,
  kIxxMinusIyy = 1 << 6,  // (Ixx - Iyy) / 2
  kIzzOfJoint = 1 << 7,
  kMass = 1 << 8,
  kHx = 1 << 9,
  kHy = 1 << 10,
  kHz = 1 << 11,
  kSlidingMass = 1 << 12,
  kSlidingHx = 1 << 13,
  kSlidingHy = 1 << 14,
  kSlidingHz = 1 << 15,
};
// What a link can have: these of its own, or of the paper's those of a revolute
// or of a prismatic joint.
constexpr unsigned kMomentsOfLink =
    kIxx | kIxy | kIyy | kIxz | kIyz | kIzz | kMass | kHx | kHy | kHz;
constexpr unsigned kMomentsOfJoint =
    kIxy | kIxz | kIyz | kIxxMinusIyy | kIzzOfJoint | kHx | kHy;
constexpr unsigned kSlidingMoments =
    kSlidingMass | kSlidingHx | kSlidingHy | kSlidingHz;

// A moment times an unknown length: kHx, kHy or kSlidingMass.
struct LengthColumn {
  LinkMoment moment;
  int length;
};

struct LinkConstants {
  bool rotational;
  // R_LP = R0 + cos(q) Rc + sin(q) Rs, by rows.
  double R0[9], Rc[9], Rs[9];
  double p_PF[3];  // m, of Fo in P, without the unknown lengths
  double p_ML[3];  // m, from Mo to Lo, in L
  double axis[3];  // of the joint, in L
  // A unit of the joint's velocity moves L so: angular, and linear of Fo. One
  // of them is the axis and the other 0, so that all joints have the same
  // formulas.
  double angular[3], linear[3];
  // Where Lo = Mo and the axis is one of L's: which, and its sense; else -1.
  int axis_index;
  double axis_sign;
  bool has_offset;  // Lo is not Fo: p_ML, or the way of a prismatic joint
  bool regrouped;   // the moments are the paper's

  unsigned moments;  // one of the sets above, or none
  bool all_moments;  // none of their places is -1
  int num_moments;
  int num_length_columns;
  const LengthColumn* length_columns;
  // For rows 0 to the link's own, places of its columns in that row: moments in
  // the order of their bits, -1 for one that is not wanted, then length
  // columns.
  const int* places;
};

// An unknown length: along axis `component` of the frame of `link`, between its
// joint and the next.
struct LengthConstants {
  int link;
  int component;
};

struct ChainConstants {
  int num_links;
  const LinkConstants* links;
  int num_lengths;
  const LengthConstants* lengths;
  double gravity[3];     // m/s^2, in the first P
  const int* row_sizes;  // columns of each row, also those of joint terms
};

// Motion of samples, an array per joint.
struct ChainMotion {
  const double* const* q;
  const double* const* qd;
  const double* const* qdd;
};

}  // namespace armcal::simd
