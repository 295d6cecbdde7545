#pragma once

#include <Eigen/Core>

#include "model/dynamics/arm_dynamics.h"
#include "model/dynamics/simulated_robot.h"
#include "model/plant/simulator_layout.h"
#include "model/plant/small_cholesky.h"
#include "model/simd/motion/w_method.h"

namespace armcal {

struct ArmSimulatorOptions {
  double step = 1e-3;  // s; the engine is asked twice per step
  // Runge-Kutta steps (fourth order) of all laws per step; 0: as many as the
  // stiffest law needs.
  int substeps = 0;
  double begin = 0;  // s, what clocks say at the start
};

// Integrates a SimulatedRobot. Friction and transmissions are stiff but cheap,
// the arm's dynamics smooth but dear: so mass matrix, bias and Jacobians come
// from the engine twice per step, at the middle and end that the step is
// predicted to have, and are interpolated while the laws run in substeps. The
// error is of third order in `step` where laws are smooth, and of first order
// where friction depends on the load, which is held from the substep before.
class ArmSimulator {
 public:
  // Starts at rest with the links at q0 (all joints, passive ones included).
  // Keeps references to both; `dynamics` is of robot.robot. A copy goes on from
  // the same state with the same engine. Throws InputError
  // where a transmission's joint has no armature, or a law other than friction
  // of a joint without one is too stiff for 64 substeps.
  ArmSimulator(const SimulatedRobot& robot, const Eigen::VectorXd& q0,
               const ArmSimulatorOptions& options, ArmDynamics* dynamics);

  // Puts the motors of all joints in this state, n entries each, rad or m and
  // per s. Before the first step their links move with them, as far behind as
  // they are at rest; later they stay where transmissions have let them go: so
  // a recorded motion leads the motors while links and laws follow.
  void SetMotors(const Eigen::VectorXd& q, const Eigen::VectorXd& qd);

  // Advances by options.step with the torques commanded to the driven joints.
  void Step(const Eigen::VectorXd& commanded);

  const ArmInstant& instant() const { return instant_; }
  bool finite() const { return x_.allFinite(); }

 private:
  struct Mode {
    double rate;  // 1/s
    int joint;    // that moves most in it; -1: none does
  };

  void SetArmature();
  int NeededSubsteps();
  Mode FastestMode();
  Eigen::MatrixXd RatesAtRest();
  Eigen::VectorXd JointDamping() const;
  void MakeImplicit(int stage, double h);
  Mode FastestDeclaredMode();
  int JointOf(Eigen::Index state) const;
  void ReadInstant(const Eigen::VectorXd& x, double t);
  void Derivative(const Eigen::VectorXd& x, double t, double share);
  void AddActuators(const Eigen::VectorXd& x);
  void AddJointLaws(const Eigen::VectorXd& x);
  void AddTransmissions(const Eigen::VectorXd& x);
  void AddWrenches(const Eigen::VectorXd& x, double t);
  void Predict(double ahead, const Eigen::VectorXd& qdd, ArmTerms* terms);
  void Substep(double t, double share, double h);

  const SimulatedRobot& robot_;
  ArmDynamics* dynamics_;
  double step_, begin_time_;
  int substeps_;
  bool implicit_ = false;
  int n_;
  std::vector<Attachment> attachments_;
  Eigen::VectorXd armature_;        // n
  Eigen::VectorXd rigid_armature_;  // of joints without a transmission
  SimulatorLayout layout_;

  long step_index_ = 0;
  Eigen::VectorXd x_;
  ArmInstant instant_;
  Eigen::VectorXd qdd_;
  Eigen::VectorXd jerk_;  // rad/s^3 or m/s^3, mean of the step before
  ArmTerms begin_, middle_, end_, now_;
  Eigen::VectorXd commanded_;

  // Scratch of Derivative.
  Eigen::VectorXd motor_torque_, link_torque_, heat_, rate_;
  Eigen::VectorXd next_load_;
  Eigen::VectorXd k_[WMethod::kStages], x_stage_;
  SmallCholesky cholesky_, implicit_cholesky_;
  Eigen::VectorXd damping_;  // n, of the substep's begin
};

}  // namespace armcal
