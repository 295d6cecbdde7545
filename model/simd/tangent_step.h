#pragma once

namespace armcal::simd {

// A stage of a Runge-Kutta step, linearised: how the torque that an arm's
// motion takes changes with position, velocity and, first columns of `direct`,
// with parameters. Matrices are stored by rows.
struct TangentStage {
  const double* inertia;  // n x n, armature included
  const double *by_q, *by_qd;
  const double* direct;  // n rows, direct_columns apart
};

// How a classical Runge-Kutta step changes with what it began from, the torque
// it was given and the parameters.
struct TangentStep {
  int num_joints;
  double step;  // s
  TangentStage stages[4];
  // Of the state and the torque's: a multiple of 8, rows `stride` apart.
  int columns;
  long stride;
  int direct_columns;  // a multiple of 8; 0: parameters act by the torque only
  // n rows each, of the torque at the step's begin, middle and end.
  const double* torque[3];
};

}  // namespace armcal::simd
