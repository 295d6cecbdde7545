#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/robot/joint.h"
#include "model/signals/trajectory.h"

namespace armcal {

// What a joint adds to its own torque:
// viscous qd + coulomb c + offset + armature qdd,
// where c in [-1, 1] is the state of Coulomb friction.
enum class JointTerm { kViscous, kCoulomb, kOffset, kArmature };
const char* JointTermName(JointTerm term);
// "N m s/rad" for viscous friction of a revolute joint.
std::string JointTermUnit(JointTerm term, JointType type);
// The term, as the joint holds it.
double* TermOf(JointTerm term, Joint* joint);
double TermOf(JointTerm term, Joint joint);

// How Coulomb friction passes through zero velocity:
//   kVelocity      c = tanh(qd / width), width in rad/s or m/s;
//   kDisplacement  c = clip(c + dq / width, -1, 1), width in rad or m: a
//                  Prandtl element, which holds its torque while the joint
//                  stands still, as joints with harmonic drives do.
struct CoulombTransition {
  enum class Law { kVelocity, kDisplacement };
  // The widths that are looked for in logs, rad/s or m/s, rad or m. What
  // changes sign over more than .3 rad/s is no dry friction but viscous
  // friction that falls off with speed: width and viscous friction then trade,
  // and what is called Coulomb friction grows with the width.
  static constexpr double kSharpestVelocity = 1e-3, kWidestVelocity = 0.3;
  static constexpr double kSharpestDisplacement = 1e-4;
  Law law = Law::kVelocity;
  double width = 0.02;

  // c at velocity qd. `state` is the displacement law's own, to be integrated
  // at StateRate(); the velocity law has none, and its rate is 0.
  double C(double qd, double state) const;
  double StateRate(double qd, double state) const;
};

// A joint's viscous and Coulomb friction and its offset, N m or N.
double FrictionTorque(const Joint& joint, const CoulombTransition& transition,
                      double qd, double state);

struct JointTermColumn {
  int joint;
  JointTerm term;
  CoulombTransition transition;  // of kCoulomb

  // The torque per unit of the parameter is d/dt P - D; `c` is the state of
  // Coulomb friction.
  double P(double qd) const { return term == JointTerm::kArmature ? qd : 0; }
  double D(double qd, double c) const;
  double Torque(double qd, double qdd, double c) const;
};

// The states c of Coulomb columns along a log; starts a segment at c = 0. Up to
// the core of a trajectory they are those of the trajectory before it, whose
// core is free of the filters' ends; the element remembers.
class CoulombStates {
 public:
  // `columns`: the kCoulomb ones are followed, in their order.
  explicit CoulombStates(const std::vector<JointTermColumn>& columns);

  int size() const { return static_cast<int>(columns_.size()); }
  // samples x size().
  const Eigen::MatrixXd& Follow(const Trajectory& trajectory);
  // The same as the trajectory's torque has them. Where that was thinned
  // (Trajectory), a row's is the mean over the step about it, from half a step
  // before to half a step after: friction that changes sign between two rows is
  // not there to be seen in either, and to take the sign at a row for that of
  // its step would be wrong by up to half of it.
  Eigen::MatrixXd FollowTorque(const Trajectory& trajectory);

 private:
  int NumKnown(const Trajectory& trajectory) const;

  std::vector<JointTermColumn> columns_;
  Eigen::MatrixXd states_;  // of the trajectory followed last
  int segment_ = -1;
  long first_index_ = 0;
};

}  // namespace armcal
