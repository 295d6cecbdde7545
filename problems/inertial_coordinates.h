#pragma once

#include <Eigen/Core>
#include <cmath>

#include "model/robot/inertial_parameters.h"

namespace armcal {

// Log-Cholesky coordinates of a rigid body's inertial parameters (Rucker and
// Wensing, RA-L 2022): the pseudo-inertia
//   [ tr(I)/2 1 - I   h ]                    [ e^d1 s12  s13  t1 ]
//   [ h'              m ] = e^(2 a) U U', U =[ 0    e^d2 s23  t2 ]
//                                            [ 0    0    e^d3 t3 ]
//                                            [ 0    0    0    1  ]
// is positive definite, so that a body with these parameters can exist, for
// every value of (a, d1, d2, d3, s12, s23, s13, t1, t2, t3).
template <class T>
void InertialFromLogCholesky(const T* c, T* V) {
  using std::exp;
  const T scale = exp(T(2) * c[0]);
  const T e1 = exp(c[1]), e2 = exp(c[2]), e3 = exp(c[3]);
  const T &s12 = c[4], &s23 = c[5], &s13 = c[6];
  const T &t1 = c[7], &t2 = c[8], &t3 = c[9];
  // Second moments, the integral of x x' over the mass.
  const T xx = e1 * e1 + s12 * s12 + s13 * s13 + t1 * t1;
  const T yy = e2 * e2 + s23 * s23 + t2 * t2;
  const T zz = e3 * e3 + t3 * t3;
  const T xy = e2 * s12 + s13 * s23 + t1 * t2;
  const T xz = e3 * s13 + t1 * t3;
  const T yz = e3 * s23 + t2 * t3;
  V[0] = scale;
  V[1] = scale * t1;
  V[2] = scale * t2;
  V[3] = scale * t3;
  V[4] = scale * (yy + zz);
  V[5] = -scale * xy;
  V[6] = scale * (xx + zz);
  V[7] = -scale * xz;
  V[8] = -scale * yz;
  V[9] = scale * (xx + yy);
}

// U of the coordinates: the pseudo-inertia is e^(2 a) U U'.
template <class T>
Eigen::Matrix<T, 4, 4> LogCholeskyFactor(const T* c) {
  using std::exp;
  const T zero(0), one(1);
  Eigen::Matrix<T, 4, 4> U;
  U << exp(c[1]), c[4], c[6], c[7],  //
      zero, exp(c[2]), c[5], c[8],   //
      zero, zero, exp(c[3]), c[9],   //
      zero, zero, zero, one;
  return U;
}

// The coordinates of physically consistent parameters. Others are moved inside
// first: eigenvalues of the central second moments are raised to at least
// (margin m)^2 times the mass, the mass to at least `least_mass` kg.
Vector10d LogCholeskyFromInertial(const Vector10d& V, double margin = 1e-3,
                                  double least_mass = 1e-3);

}  // namespace armcal
