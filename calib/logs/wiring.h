#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/robot/robot.h"
#include "model/signals/motion.h"

namespace armcal {

// Samples of a log's columns as they came, some hundred of them while the arm
// moves: the motion of what is called joint 1, 2, .. and its torque.
struct WiringSamples {
  Motion motion;
  Eigen::MatrixXd tau;  // samples x n
};

// Which columns belong to which joint, and with what sign. A column of the
// position stands for those of velocity and command as well.
struct Wiring {
  std::vector<int> position_column, torque_column;  // of each joint, from 0
  Eigen::VectorXd position_sign, torque_sign;       // of each joint, +-1

  explicit Wiring(int num_joints);
};

// The samples as joints have them if that is the wiring.
WiringSamples Rewired(const WiringSamples& samples, const Wiring& wiring);

// How well torques fit an arm that moves like this, with inertias, friction and
// armature fitted as they can be: friction takes power, masses and moments of
// inertia are not negative, and inertias are those of the file to their own
// size (InertialPrior, trust 1). Nothing is asked of a joint where it stands
// still.
class TorqueFit {
 public:
  TorqueFit(const Robot& robot, const Motion& motion);

  // Half the sum over joints and samples of the log of the mean square
  // residual, in nats; small is good. `tau`: samples x n, N m or N.
  // `residual_percent`, unless null: of all torques.
  double Misfit(const Eigen::MatrixXd& tau,
                double* residual_percent = nullptr) const;

  // The fitted inertias and joint terms; Squares asks another motion's fit what
  // they leave of torques there: their sums of squares, (N m)^2, per joint.
  Eigen::VectorXd Parameters(const Eigen::MatrixXd& tau) const;
  Eigen::VectorXd Squares(const Eigen::VectorXd& parameters,
                          const Eigen::MatrixXd& tau) const;
  // What is left, as Squares has it, of torques by joint terms alone that are
  // fitted beside the bodies of the robot file as they are, or beside none.
  Eigen::VectorXd SquaresBesideFile(const Eigen::MatrixXd& tau) const;
  Eigen::VectorXd SquaresBesideNoBodies(const Eigen::MatrixXd& tau) const;
  // samples x n, N m or N.
  Eigen::MatrixXd Torque(const Eigen::VectorXd& parameters) const;
  // Torques that the fit takes notice of; 0 where a joint stands still.
  Eigen::MatrixXd InMotion(const Eigen::MatrixXd& tau) const {
    return moves_.cwiseProduct(tau);
  }

 private:
  // What the rounds of a fit come to.
  struct Fitted {
    Eigen::VectorXd x, squares;  // parameters; per joint, as Squares has them
    double misfit = 0;           // nats
  };
  Fitted FitTo(const Eigen::MatrixXd& tau) const;
  // Parameters that are `held` stay at zero.
  Fitted FitTo(const Eigen::MatrixXd& tau, std::vector<bool> held) const;
  Eigen::VectorXd Solve(const Eigen::MatrixXd& tau,
                        const Eigen::VectorXd& variance,
                        const std::vector<bool>& held) const;

  std::vector<Eigen::MatrixXd> columns_, squares_;  // per joint
  Eigen::MatrixXd moves_;  // samples x n: 1 where the joint moves, else 0
  std::vector<int> not_negative_;
  Eigen::VectorXd nominal_;
  Eigen::MatrixXd prior_;
};

}  // namespace armcal
