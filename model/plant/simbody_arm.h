#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/dynamics/arm_dynamics.h"
#include "model/robot/robot.h"

namespace armcal {

// A robot's rigid dynamics by Simbody 3.7, which shares no code with ours.
// Vectors have n entries in the robot's joint order; units as in model/. Links
// may be massless; friction and armature are not included. Keeps scratch, so
// use one per thread.
class SimbodyArm : public ArmDynamics {
 public:
  // Throws InputError, which names the link, where Simbody refuses a link's
  // mass or inertia.
  explicit SimbodyArm(const Robot& robot);
  ~SimbodyArm() override;
  SimbodyArm(SimbodyArm&&) noexcept;

  int num_joints() const override;
  void Evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& qd,
                const std::vector<Attachment>& attachments,
                ArmTerms* terms) override;

  Eigen::VectorXd InverseDynamics(const Eigen::VectorXd& q,
                                  const Eigen::VectorXd& qd,
                                  const Eigen::VectorXd& qdd);
  // What the last joint gives to its link, (force, N; moment about Lo, N m)
  // expressed in the link's frame L, while the arm moves so: Simbody's reaction
  // of that mobilizer, gravity taken into account.
  Eigen::Matrix<double, 6, 1> LastReaction(const Eigen::VectorXd& q,
                                           const Eigen::VectorXd& qd,
                                           const Eigen::VectorXd& qdd);
  Eigen::MatrixXd MassMatrix(const Eigen::VectorXd& q);
  Eigen::VectorXd GravityTorque(const Eigen::VectorXd& q);  // holds the arm
  // J; the potential energy's zero is that of masses at Wo.
  double KineticEnergy(const Eigen::VectorXd& q, const Eigen::VectorXd& qd);
  double PotentialEnergy(const Eigen::VectorXd& q);

  // Lets the arm swing without torque or friction for `duration` s from (q, qd)
  // by Simbody's own Runge-Kutta-Merson integrator, whose relative local
  // error is `accuracy`. False where that fails (a massless tip) or takes
  // more than `max_steps`.
  bool Swing(double duration, double accuracy, int max_steps,
             Eigen::VectorXd* q, Eigen::VectorXd* qd);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace armcal
