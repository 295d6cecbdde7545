#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace armcal {

// A point fixed in a link, where something outside the arm acts on it.
struct Attachment {
  int link = 0;                                    // from 0, base to tip
  Eigen::Vector3d p_LP = Eigen::Vector3d::Zero();  // m
};

// A rigid arm at (q, qd):  mass_matrix qdd + bias = tau + sum of J^T F.
struct ArmTerms {
  struct Point {
    Eigen::Isometry3d X_WP;  // axes of the link, origin at the attachment
    // (w_WP; v_WP) = jacobian qd, expressed in W; 6 x n.
    Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian;
  };
  Eigen::MatrixXd mass_matrix;  // n x n, of the links; no armature
  Eigen::VectorXd bias;         // n, velocity terms and gravity, N m or N
  std::vector<Point> points;    // of the attachments asked for
};

// An engine that knows the rigid dynamics of one arm: our own, or Simbody.
class ArmDynamics {
 public:
  virtual ~ArmDynamics() = default;
  virtual int num_joints() const = 0;
  virtual void Evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                        const std::vector<Attachment>& attachments,
                        ArmTerms* terms) = 0;
};

}  // namespace armcal
