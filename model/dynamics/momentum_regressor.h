#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "model/dynamics/proximal_chain.h"

namespace armcal {

// The functions of one model parameter before regrouping: a moment of the
// composite inertia K_block, times an unknown length where length >= 0.
enum class Moment { kM, kHx, kHy, kHz, kIxxMinusIyy, kIxy, kIxz, kIyz, kIzz };
struct MomentColumn {
  int block;      // 0-based joint
  Moment moment;  // kIxxMinusIyy stands for (Ixx - Iyy) / 2
  int length;     // index into `unknown`, -1 for the monomial 1
};

// Evaluates, for one state, what the Lagrangian's functions F_c contribute to
// each joint's equation: P(k, c) = dF_c/dqd_k and D(k, c) = dF_c/dq_k (both
// n x number of columns, zero below the block triangle). The torque is
// sum_c X_c (d/dt P - D), (2.20), and for (2.27) and the weak form no
// acceleration is needed.
//
// The unknown lengths are the columns' coefficients: the monomial 1 is the arm
// with all unknown lengths 0, that of l the arm with only l = 1 minus it, as
// both are affine in them (docs/theory.md, 1). T is a scalar that carries
// derivatives; numbers alone are evaluated by Regressor.
template <class T>
class MomentumRegressor {
 public:
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  MomentumRegressor(const ProximalChain& chain,
                    const std::vector<Length>& unknown);

  void Evaluate(const Vector& q, const Vector& qd,
                const std::vector<MomentColumn>& columns, Matrix* P, Matrix* D);

 private:
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  using Matrix3 = Eigen::Matrix<T, 3, 3>;
  // The state of joint k in W. Entry u = 0 of `position` and
  // `velocity` (of Jo, without the slide of a prismatic joint) holds the known
  // lengths, entry u > 0 the part that multiplies unknown length u - 1.
  struct JointState {
    Matrix3 R;      // of the proximal frame J
    Vector3 omega;  // of J
    Vector3 omega_cross_z;
    Vector3 slide, slide_rate;  // of a prismatic joint: z q and its velocity
    std::vector<Vector3> position, velocity;
    Vector3 z() const { return R.col(2); }
  };

  void Propagate(const Vector& q, const Vector& qd);
  void SecondMoment(const MomentColumn& column, const T& qd_block, int c,
                    Matrix* P, Matrix* D) const;
  void FirstMomentRevolute(const MomentColumn& column, int c, Matrix* P,
                           Matrix* D) const;
  void MassPrismatic(const MomentColumn& column, int c, Matrix* P,
                     Matrix* D) const;
  void FirstMomentPrismatic(const MomentColumn& column, int c, Matrix* P,
                            Matrix* D) const;
  bool Rotational(int k) const { return IsRotational(joints_[k].type); }

  std::vector<ProximalJoint> joints_;
  LinkParents parents_;
  Eigen::Vector3d gravity_;
  // [joint][u]: from Jo of the joint before to Go
  std::vector<std::vector<Eigen::Vector3d>> step_;
  std::vector<JointState> state_;
};

}  // namespace armcal
