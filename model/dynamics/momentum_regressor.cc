#include "model/dynamics/momentum_regressor.h"

#include <glog/logging.h>

#include <cmath>
#include <unsupported/Eigen/AutoDiff>

namespace armcal {

using std::cos;
using std::sin;

template <class T>
MomentumRegressor<T>::MomentumRegressor(const ProximalChain& chain,
                                        const std::vector<Length>& unknown)
    : joints_(chain.joints), parents_(chain.parents), gravity_(chain.gravity) {
  const size_t n = joints_.size();
  const size_t units = unknown.size() + 1;
  step_.assign(n, std::vector<Eigen::Vector3d>(units, Eigen::Vector3d::Zero()));
  for (size_t k = 0; k < n; ++k) step_[k][0] = joints_[k].X_JG.translation();
  for (size_t u = 1; u < units; ++u) {
    const Length& length = unknown[u - 1];
    step_[length.next][0][length.component] = 0;
    step_[length.next][u][length.component] = 1;
  }
  state_.resize(n);
  for (JointState& s : state_) {
    s.slide.setZero();
    s.slide_rate.setZero();
    s.position.assign(units, Vector3::Zero());
    s.velocity.assign(units, Vector3::Zero());
  }
}

template <class T>
void MomentumRegressor<T>::Propagate(const Vector& q, const Vector& qd) {
  for (int k = 0; k < static_cast<int>(joints_.size()); ++k) {
    JointState& s = state_[k];
    const int parent = ParentOf(parents_, k);
    // Of G_k, the joint's fixed frame.
    Matrix3 R_G = joints_[k].X_JG.linear().template cast<T>();
    if (parent >= 0) {
      const JointState& before = state_[parent];
      R_G = before.R * R_G;
      s.omega = before.omega;
      for (size_t u = 0; u < step_[k].size(); ++u) {
        const Vector3 step = before.R * step_[k][u].template cast<T>();
        s.position[u] = before.position[u] + step;
        s.velocity[u] = before.velocity[u] + before.omega.cross(step);
      }
      if (!Rotational(parent)) {
        s.position[0] += before.slide;
        s.velocity[0] += before.slide_rate;
      }
    } else {
      s.omega.setZero();
    }
    const bool rotational = Rotational(k);
    const T angle =
        rotational ? T(q[k] + joints_[k].theta) : T(joints_[k].theta);
    const T c = cos(angle);
    const T sn = sin(angle);
    s.R.col(0) = c * R_G.col(0) + sn * R_G.col(1);
    s.R.col(1) = c * R_G.col(1) - sn * R_G.col(0);
    s.R.col(2) = R_G.col(2);
    if (rotational) s.omega += s.z() * qd[k];
    s.omega_cross_z = s.omega.cross(s.z());
    if (rotational) continue;
    s.slide = s.z() * q[k];
    s.slide_rate = s.omega.cross(s.slide) + s.z() * qd[k];
  }
}

// With h the momentum of a unit of the moment and S_k the joint's screw,
// P_k = S_k . h and D_k = (V_k x S_k) . h + S_k . (gravity wrench). A second
// moment has angular momentum only; that of Izz, less that of the same inertia
// attached to link block - 1, is z qd.
template <class T>
void MomentumRegressor<T>::SecondMoment(const MomentColumn& column,
                                        const T& qd_block, int c, Matrix* P,
                                        Matrix* D) const {
  const JointState& s = state_[column.block];
  const Vector3 w = s.R.transpose() * s.omega;
  const T zero(0);
  Vector3 body(zero, zero, zero);
  switch (column.moment) {
    case Moment::kIxxMinusIyy:
      body = Vector3(w[0], -w[1], zero);
      break;
    case Moment::kIxy:
      body = Vector3(w[1], w[0], zero);
      break;
    case Moment::kIxz:
      body = Vector3(w[2], zero, w[0]);
      break;
    case Moment::kIyz:
      body = Vector3(zero, w[2], w[1]);
      break;
    default:
      body = Vector3(zero, zero, w[2]);
  }
  const Vector3 angular = s.R * body;
  const Vector3 distal = s.z() * qd_block;
  for (int k = column.block; k >= 0; k = ParentOf(parents_, k)) {
    if (!Rotational(k)) continue;
    const bool regrouped = column.moment == Moment::kIzz && k < column.block;
    const Vector3& A = regrouped ? distal : angular;
    (*P)(k, c) = state_[k].z().dot(A);
    (*D)(k, c) = state_[k].omega_cross_z.dot(A);
  }
}

template <class T>
void MomentumRegressor<T>::FirstMomentRevolute(const MomentColumn& column,
                                               int c, Matrix* P,
                                               Matrix* D) const {
  const JointState& s = state_[column.block];
  const int u = column.length + 1;
  const Vector3 e = s.R.col(column.moment == Moment::kHx ? 0 : 1);
  const Vector3 linear = s.omega.cross(e);
  const Vector3 angular = e.cross(s.velocity[u]);  // about Jo of the block
  const Vector3 moment = e.cross(gravity_.template cast<T>());
  for (int k = column.block; k >= 0; k = ParentOf(parents_, k)) {
    const JointState& j = state_[k];
    if (!Rotational(k)) {
      if (u > 0) continue;
      (*P)(k, c) = j.z().dot(linear);
      (*D)(k, c) = j.omega_cross_z.dot(linear);
      continue;
    }
    const Vector3 A =
        angular + Vector3(s.position[u] - j.position[u]).cross(linear);
    (*P)(k, c) = j.z().dot(A);
    (*D)(k, c) =
        j.omega_cross_z.dot(A) + j.velocity[u].cross(j.z()).dot(linear);
    if (u == 0) (*D)(k, c) += j.z().dot(moment);
  }
}

// A prismatic block, less the same inertia attached to link block - 1 at q = 0
// for the rows before it: its mass moves by `slide`.
template <class T>
void MomentumRegressor<T>::MassPrismatic(const MomentColumn& column, int c,
                                         Matrix* P, Matrix* D) const {
  const int i = column.block;
  const JointState& s = state_[i];
  const int u = column.length + 1;
  const Vector3 g = gravity_.template cast<T>();
  const Vector3 moment = s.slide.cross(g);
  Vector3 angular = s.slide.cross(s.velocity[u]);
  if (u == 0) angular += s.slide.cross(s.slide_rate);
  for (int k = ParentOf(parents_, i); k >= 0; k = ParentOf(parents_, k)) {
    const JointState& j = state_[k];
    if (!Rotational(k)) {
      if (u > 0) continue;
      (*P)(k, c) = j.z().dot(s.slide_rate);
      (*D)(k, c) = j.omega_cross_z.dot(s.slide_rate);
      continue;
    }
    const Vector3 A =
        angular + Vector3(s.position[u] - j.position[u]).cross(s.slide_rate);
    (*P)(k, c) = j.z().dot(A);
    (*D)(k, c) =
        j.omega_cross_z.dot(A) + j.velocity[u].cross(j.z()).dot(s.slide_rate);
    if (u == 0) (*D)(k, c) += j.z().dot(moment);
  }
  Vector3 velocity = s.velocity[u];
  if (u == 0) velocity += s.slide_rate;
  (*P)(i, c) = s.z().dot(velocity);
  (*D)(i, c) = s.omega_cross_z.dot(velocity);
  if (u == 0) (*D)(i, c) += s.z().dot(g);
}

template <class T>
void MomentumRegressor<T>::FirstMomentPrismatic(const MomentColumn& column,
                                                int c, Matrix* P,
                                                Matrix* D) const {
  const int i = column.block;
  const JointState& s = state_[i];
  const int axis =
      static_cast<int>(column.moment) - static_cast<int>(Moment::kHx);
  const Vector3 e = s.R.col(axis);
  const Vector3 linear = s.omega.cross(e);
  const Vector3 A = e.cross(s.slide_rate) + s.slide.cross(linear);
  for (int k = ParentOf(parents_, i); k >= 0; k = ParentOf(parents_, k)) {
    if (!Rotational(k)) continue;
    (*P)(k, c) = state_[k].z().dot(A);
    (*D)(k, c) = state_[k].omega_cross_z.dot(A);
  }
  (*P)(i, c) = s.z().dot(linear);
  (*D)(i, c) = s.omega_cross_z.dot(linear);
}

template <class T>
void MomentumRegressor<T>::Evaluate(const Vector& q, const Vector& qd,
                                    const std::vector<MomentColumn>& columns,
                                    Matrix* P, Matrix* D) {
  const int n = static_cast<int>(joints_.size());
  CHECK(q.size() == n && qd.size() == n);
  Propagate(q, qd);
  for (size_t c = 0; c < columns.size(); ++c) {
    P->col(c).setZero();
    D->col(c).setZero();
    const MomentColumn& column = columns[c];
    if (column.moment >= Moment::kIxxMinusIyy) {
      SecondMoment(column, qd[column.block], c, P, D);
    } else if (Rotational(column.block)) {
      FirstMomentRevolute(column, c, P, D);
    } else if (column.moment == Moment::kM) {
      MassPrismatic(column, c, P, D);
    } else {
      FirstMomentPrismatic(column, c, P, D);
    }
  }
}

template class MomentumRegressor<
    Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>>;
template class MomentumRegressor<Eigen::AutoDiffScalar<
    Eigen::Matrix<Eigen::AutoDiffScalar<Eigen::Matrix<double, 8, 1>>, 1, 1>>>;

}  // namespace armcal
