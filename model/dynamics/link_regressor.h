#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/robot/link_paths.h"
#include "model/robot/robot.h"

namespace armcal {

class RegressorPlan;

// The regressor of the links' ten inertial parameters each (ToVector()'s order,
// about the links' own frames), for a robot of known geometry: with V of all
// links stacked, dL/dqd = P V and dL/dq = D V, so that the torque is
// d/dt (P V) - D V. Unlike ModelParameters' columns these are dependent, and
// mean what a robot file holds. Keeps scratch, so use one per thread.
class LinkRegressor {
 public:
  explicit LinkRegressor(const Robot& robot);

  int num_joints() const { return static_cast<int>(joints_.size()); }
  // P and D: n x 10 n, zero below the block triangle. For many samples
  // BatchRegressor is faster.
  void Momentum(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                Eigen::MatrixXd* P, Eigen::MatrixXd* D);
  // P V and D V at once, n entries each; shares no code with the other.
  void Momentum(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                const Eigen::VectorXd& V, Eigen::VectorXd* PV,
                Eigen::VectorXd* DV);

 private:
  using Vector6d = Eigen::Matrix<double, 6, 1>;  // angular, linear; in W at Wo
  using Matrix6x10 = Eigen::Matrix<double, 6, 10>;
  struct JointState {
    Vector6d screw;         // S_k
    Vector6d screw_change;  // V_k x S_k
    Vector6d twist;         // of the link
    Eigen::Isometry3d X_WL;
  };
  struct ConstantJoint {
    JointType type;
    Eigen::Isometry3d X_PF, X_ML;
  };

  void Propagate(const Eigen::VectorXd& q, const Eigen::VectorXd& qd);
  // Momentum of link i, and its gravity wrench, per unit of each parameter.
  Matrix6x10 LinkMomentum(int i) const;
  Matrix6x10 LinkGravity(int i) const;

  std::vector<ConstantJoint> joints_;
  LinkParents parents_;
  Eigen::Vector3d gravity_;
  std::vector<JointState> state_;
  std::shared_ptr<const RegressorPlan> plan_;
};

}  // namespace armcal
