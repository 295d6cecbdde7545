#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/model_parameters.h"
#include "model/dynamics/regressor_gradient.h"
#include "model/robot/robot.h"
#include "model/signals/motion.h"

namespace armcal {

// Of some number, in positions, velocities and accelerations of each sample:
// samples x joints.
struct MotionGradient {
  Eigen::MatrixXd q, qd, qdd;

  MotionGradient() = default;
  explicit MotionGradient(const Motion& motion)
      : q(Eigen::MatrixXd::Zero(motion.size(), motion.num_joints())),
        qd(q),
        qdd(q) {}
};

// What the torques of a motion would tell about the model parameters X:
//   A = sum over samples and joints of weight_j u' u,
// with u joint j's row of the regressor; and how A and the torque of given
// parameters change with the motion. Works on several threads; results do not
// depend on how many.
class MotionInformation {
 public:
  // Coulomb columns of `model` must follow the velocity law. `robot` is the one
  // that `model` is of.
  MotionInformation(const Robot& robot, const ModelParameters& model);

  // Moves to a motion. `weight`: per joint, of a sample's equation: 1 / (N m)^2
  // or 1 / N^2.
  void Evaluate(const Motion& motion, const Eigen::VectorXd& weight);

  const Eigen::MatrixXd& A() const { return A_; }  // m x m
  // The sum over samples and joints of weight_j u' times another torque there
  // (samples x joints): m entries.
  Eigen::VectorXd Project(const Eigen::MatrixXd& torque,
                          const Eigen::VectorXd& weight) const;
  // Torques of parameters x there, samples x joints.
  Eigen::MatrixXd Torque(const Eigen::VectorXd& x) const;

  // Adds the gradient of f(A, torque) from those in A (m x m, symmetric) and in
  // the torque of x (samples x joints).
  void AddGradient(const Eigen::MatrixXd& of_A, const Eigen::VectorXd& x,
                   const Eigen::MatrixXd& of_torque, MotionGradient* gradient);

 private:
  template <typename Work>
  void OnAllThreads(const Work& work);

  int num_parameters_;
  std::vector<std::vector<int>> columns_;       // of each joint's equation
  std::vector<CoulombTransition> transitions_;  // of Coulomb columns, in order
  std::vector<int> coulomb_joints_;
  std::vector<Regressor> regressors_;  // one per thread
  std::vector<RegressorGradient> gradients_;
  Motion motion_;
  Eigen::VectorXd weight_;
  std::vector<Eigen::MatrixXd> rows_;  // per joint: samples x columns
  Eigen::MatrixXd A_;
};

}  // namespace armcal
