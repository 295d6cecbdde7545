#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"

namespace armcal {

// The laws of a corrected robot beside a simulator of its rigid links, which
// knows only torques, positions and velocities at its own steps. This is how
// the modules for other simulators (assets/) go on from step to step, by the
// laws themselves: what the modules, which have laws of their own, are compared
// with.
//
// At a step the state of bristles follows the way that the joint went since the
// step before, warmth the power of friction then, and a motor on a spring moves
// while its link goes evenly from where it was to where it is. The torque is
// that at the instant; a simulator that steps velocities first and positions by
// them (semi-implicit) then errs by the square of its step. What a spring gave
// its motor between steps, as a flank does that is struck, the link is given at
// the next: momentum is kept.
class EffectSteps {
 public:
  // Keeps a reference. `load`: what joints hold at rest at the begin, N m or N,
  // which winds up springs; empty: not known, they are slack.
  explicit EffectSteps(const CorrectedRobot& robot,
                       const Eigen::VectorXd& load = {});

  void SetTime(double t) { at_.t = t; }
  void SetWarmth(const Eigen::VectorXd& kelvin) { at_.temperature = kelvin; }

  // The simulator's joints are at q, qd, `dt` s after the call before; what
  // encoders say, which sit on the motors.
  Eigen::VectorXd Sense(double dt, const Eigen::VectorXd& q,
                        const Eigen::VectorXd& qd);
  // The torques on the simulator's joints for those commanded. `load`: what
  // joints hand to their links; empty: as follows from the torque before.
  Eigen::VectorXd Act(const Eigen::VectorXd& commanded,
                      const Eigen::VectorXd& load = {});
  // After Act: how fast the torque falls with velocity, not below 0, and the
  // torque with as much added to it: for simulators whose joints are implicit
  // in their damping.
  const Eigen::VectorXd& damping() const { return damping_; }
  const Eigen::VectorXd& undamped() const { return undamped_; }

 private:
  struct Bristles {  // of an effect's joint law
    const JointLaw* law;
    Eigen::VectorXd state, rate;
  };

  void Start(const Eigen::VectorXd& q, const Eigen::VectorXd& qd);
  void Advance(double dt, const Eigen::VectorXd& q, const Eigen::VectorXd& qd);
  void AdvanceSlowStates(double dt, const Eigen::VectorXd& qd);
  void AdvanceMotor(int j, double dt, double link_before);
  void MotorStep(int j, double h);
  void Follow(int j, double move, double h);
  // Of the joint's own friction and of the effects' laws on it, N m or N.
  double OwnFriction(int j) const;
  double OnMotor(int j);
  double Heating(int j);
  double FrictionSlope(int j);
  double SpringTorque(int j, double more, double faster) const;
  double SlopeOverRate(int j) const;
  double SlopeOverDeflection(int j) const;
  double Armature(int j) const;  // of the rigid joint

  const CorrectedRobot& robot_;
  int n_;
  std::vector<const Transmission*> springs_;  // per joint, null: rigid
  std::vector<Bristles> laws_;
  std::vector<Eigen::VectorXd> yielding_;  // per joint, a number per part
  ArmInstant at_;
  bool started_ = false, acted_ = false, load_known_;
  Eigen::VectorXd lag_, commanded_, given_, drive_, heat_, damping_, undamped_;
  Eigen::VectorXd change_;  // of links' velocities in the last step
  // What springs have given motors in the last step and their links not, mean.
  Eigen::VectorXd missing_, spring_;
};

}  // namespace armcal
