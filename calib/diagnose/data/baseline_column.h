#pragma once

namespace armcal {

// One thing that the model may vary, in units of its prior's standard
// deviation (of what a calibration knows better, by the robot file): an
// inertial parameter, a joint term, or a nuisance (how friction changes sign,
// how torque and position are shifted in time), or an effect that the robot is
// known to have.
struct BaselineColumn {
  // kDay: a joint term (friction, the torque's zero) in the diagnosed logs
  // only, not in a reference. kDiscrepancy: what models of robots lack as a
  // rule (discrepancy.h).
  enum class Kind {
    kInertial,
    kTerm,
    kZeroVelocity,
    kReversal,
    kTiming,
    kDay,
    kEffect,
    kDiscrepancy
  };
  Kind kind;
  int joint;      // or link; -1: all
  int index = 0;  // inertial parameter or JointTerm or shape or parameter of
                  // KnownEffects or shape of Discrepancy
  double spread;  // SI units per unit of the column

  // Whether it is one of the changes of friction near zero velocity that are
  // fitted where its width is not known: half and twice the usual width.
  bool IsZeroVelocityWidth() const {
    return kind == Kind::kZeroVelocity && (index == 1 || index == 2);
  }
};

}  // namespace armcal
