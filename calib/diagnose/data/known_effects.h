#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/recorded_torque.h"
#include "model/effects/effect.h"

namespace armcal {

// An effect that the robot is known to have: not what a diagnosis asks for.
struct KnownEffect {
  const Effect* effect = nullptr;
  int joint = -1;     // from 0; -1: the whole robot
  Eigen::VectorXd p;  // all its parameters
};

// The dry friction of joints as a reference showed it.
struct DryFriction {
  std::vector<double> coulomb;    // beside the laws, N m or N per joint
  std::vector<KnownEffect> laws;  // at the sizes that go with it
};

// Several of them. Their shapes are given; each linear parameter is uncertain
// by as much as it is large, or as its usual size where it is smaller.
class KnownEffects {
 public:
  KnownEffects() = default;
  // `scale`: of the logs that showed them. `friction`: with those of them that
  // are dry friction and well told.
  KnownEffects(const Robot& robot, std::vector<KnownEffect> effects,
               const MotionScale& scale, DryFriction friction);

  struct Parameter {
    int effect;     // its place among the effects
    int joint;      // the effect's
    int index;      // of p
    double spread;  // standard deviation, the parameter's unit
    double dry;     // what it has in DryFriction, in units of `spread`
  };
  const std::vector<Parameter>& parameters() const { return parameters_; }
  const MotionScale& scale() const { return scale_; }
  // DryFriction's; `alone`, the joint's own, where there are no effects.
  double CoulombBeside(int joint, double alone) const {
    return coulomb_.empty() ? alone : coulomb_[joint];
  }
  // Torque of all joints by each parameter at its spread: samples x n.
  std::vector<Eigen::MatrixXd> Torques(const Robot& robot,
                                       RecordedTorque torque) const;
  // The effects with these linear parameters, in units of their spreads.
  std::vector<KnownEffect> At(const Eigen::VectorXd& values) const;

 private:
  std::vector<KnownEffect> effects_;  // linear parameters 0
  std::vector<Parameter> parameters_;
  MotionScale scale_;
  std::vector<double> coulomb_;
};

}  // namespace armcal
