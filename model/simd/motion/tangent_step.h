#pragma once

namespace armcal::simd {

// A stretch of an arm's motion in which its torque is constant, linearised
// about its mean state: how the torque that the motion takes changes with
// position, velocity and, first columns of `direct`, with parameters. Matrices
// are stored by rows.
struct TangentStep {
  int num_joints;
  double length;  // s
  // n x n, with armature and half the length's worth of friction's slopes: the
  // step is implicit in these.
  const double* inertia;
  const double *by_q, *by_qd;
  const double* direct;  // n rows, direct_columns apart
  // Of the state and the torque's: a multiple of 8, rows `stride` apart.
  int columns;
  long stride;
  int direct_columns;  // a multiple of 8; 0: parameters act by the torque only
  const double* torque;  // n rows
};

}  // namespace armcal::simd
