#pragma once

#include <cmath>

namespace armcal {

// A state of a six-joint arm, and the torque there.
struct SixAxisSample {
  double q[6], qd[6], qdd[6], tau[6];  // rad, rad/s, rad/s^2, N m
};

// Recursive Newton-Euler, spelled out: with Eigen's products of automatic
// derivatives it takes twice as long. Per link mass, first moment and inertia
// about the link's origin; modified DH rows a, alpha, d, theta.
template <class T>
class SixAxisTorque {
 public:
  void Evaluate(const T* inertial, const T* dh, const SixAxisSample& at,
                T* tau) {
    T w[3] = {T(0), T(0), T(0)}, dw[3] = {T(0), T(0), T(0)};
    T a[3] = {T(0), T(0), T(9.81)};
    for (int i = 0; i < 6; ++i) {
      SetPose(dh + 4 * i, at.q[i], i);
      if (i > 0) MoveOrigin(i, a);
      ToLink(i, a);
      if (i > 0) ToLink(i, w), ToLink(i, dw);
      dw[0] += w[1] * at.qd[i];
      dw[1] -= w[0] * at.qd[i];
      dw[2] += at.qdd[i];
      w[2] += at.qd[i];
      SetWrench(inertial + 10 * i, w, dw, a, i);
    }
    for (int i = 6 - 1; i >= 0; --i) {
      tau[i] = m_[i][2];
      if (i > 0) AddToParent(i);
    }
  }

 private:
  void SetPose(const T* dh, double q, int i) {
    using std::cos, std::sin;
    ca_[i] = cos(dh[1]);
    sa_[i] = sin(dh[1]);
    c_[i] = cos(dh[3] + q);
    s_[i] = sin(dh[3] + q);
    p_[i][0] = dh[0];
    p_[i][1] = -dh[2] * sa_[i];
    p_[i][2] = dh[2] * ca_[i];
  }
  // x of the parent's axes to the link's.
  void ToLink(int i, T* x) const {
    const T y = ca_[i] * x[1] + sa_[i] * x[2];
    const T z = ca_[i] * x[2] - sa_[i] * x[1];
    const T along = c_[i] * x[0] + s_[i] * y;
    x[1] = c_[i] * y - s_[i] * x[0];
    x[0] = along;
    x[2] = z;
  }
  void ToParent(int i, const T* x, T* y) const {
    const T across = s_[i] * x[0] + c_[i] * x[1];
    y[0] = c_[i] * x[0] - s_[i] * x[1];
    y[1] = ca_[i] * across - sa_[i] * x[2];
    y[2] = sa_[i] * across + ca_[i] * x[2];
  }
  // From the parent's origin to the link's: dw x p + w x (w x p).
  void MoveOrigin(int i, T* a) const {
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) a[k] += B_[k][l] * p_[i][l];
    }
  }
  void SetWrench(const T* P, const T* w, const T* dw, const T* a, int i) {
    const T xx = w[0] * w[0], yy = w[1] * w[1], zz = w[2] * w[2];
    const T xy = w[0] * w[1], xz = w[0] * w[2], yz = w[1] * w[2];
    B_[0][0] = -(yy + zz), B_[0][1] = xy - dw[2], B_[0][2] = xz + dw[1];
    B_[1][0] = xy + dw[2], B_[1][1] = -(xx + zz), B_[1][2] = yz - dw[0];
    B_[2][0] = xz - dw[1], B_[2][1] = yz + dw[0], B_[2][2] = -(xx + yy);
    const T* h = P + 1;
    for (int k = 0; k < 3; ++k) {
      f_[i][k] =
          P[0] * a[k] + B_[k][0] * h[0] + B_[k][1] * h[1] + B_[k][2] * h[2];
    }
    const T Iw[3] = {P[4] * w[0] + P[5] * w[1] + P[7] * w[2],
                     P[5] * w[0] + P[6] * w[1] + P[8] * w[2],
                     P[7] * w[0] + P[8] * w[1] + P[9] * w[2]};
    const T Idw[3] = {P[4] * dw[0] + P[5] * dw[1] + P[7] * dw[2],
                      P[5] * dw[0] + P[6] * dw[1] + P[8] * dw[2],
                      P[7] * dw[0] + P[8] * dw[1] + P[9] * dw[2]};
    for (int k = 0; k < 3; ++k) {
      const int x = (k + 1) % 3, y = (k + 2) % 3;
      m_[i][k] =
          Idw[k] + w[x] * Iw[y] - w[y] * Iw[x] + h[x] * a[y] - h[y] * a[x];
    }
  }
  void AddToParent(int i) {
    T f[3], m[3];
    ToParent(i, f_[i], f);
    ToParent(i, m_[i], m);
    for (int k = 0; k < 3; ++k) {
      const int x = (k + 1) % 3, y = (k + 2) % 3;
      f_[i - 1][k] += f[k];
      m_[i - 1][k] += m[k] + p_[i][x] * f[y] - p_[i][y] * f[x];
    }
  }

  T ca_[6], sa_[6], c_[6], s_[6];  // of the rows
  T p_[6][3];                      // of the link's origin in its parent
  T B_[3][3];                      // acceleration per place in the last link
  T f_[6][3], m_[6][3];            // wrenches of the links' motion
};

}  // namespace armcal
