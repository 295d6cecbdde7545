#pragma once

#include <Eigen/Core>

#include "model/dynamics/joint_term.h"
#include "model/dynamics/model_parameters.h"
#include "model/signals/trajectory.h"

namespace armcal {

// How the torque U(q, qd, qdd) x of model parameters follows a motion that is
// itself uncertain: its derivatives by position, velocity and acceleration, and
// by the widths of Coulomb friction. Like MotionFunctions, one for each pass
// over a log.
class TorqueSensitivity {
 public:
  explicit TorqueSensitivity(const ModelParameters& parameters);

  // Coulomb columns, in the order of the regressor's: each has a width.
  int num_widths() const { return coulomb_.size(); }
  // The parameter and the joint that a width belongs to.
  int width_parameter(int w) const { return width_parameter_[w]; }
  int width_joint(int w) const { return width_joint_[w]; }

  // Uses q, qd and qdd of `trajectory`, which must stay.
  void Enter(const Trajectory& trajectory);
  // U (n x parameters).
  void Regress(int sample, Eigen::MatrixXd* U);
  // d tau / d (q, qd, qdd): n x 3 n. The state of displacement friction is
  // taken as it is; friction by velocity moves with the velocity.
  void Differentiate(int sample, const Eigen::VectorXd& x, Eigen::MatrixXd* T);
  // d state / d log(width) of width w.
  double WidthDerivative(int sample, int w) const;

 private:
  Eigen::VectorXd Torque(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                         const Eigen::VectorXd& qdd, const Eigen::VectorXd& c,
                         const Eigen::VectorXd& x);

  Regressor regressor_;
  std::vector<JointTermColumn> widths_;  // the Coulomb columns
  std::vector<int> width_parameter_, width_joint_;
  CoulombStates coulomb_, wider_, narrower_;
  const Trajectory* trajectory_ = nullptr;
  Eigen::MatrixXd states_, wider_states_, narrower_states_;
  Eigen::MatrixXd U_;
};

}  // namespace armcal
