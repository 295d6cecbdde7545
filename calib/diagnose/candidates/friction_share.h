#pragma once

#include "calib/diagnose/candidates/corrected_robot.h"

namespace armcal {

// What a file that has viscous and Coulomb friction alone can hold of a law of
// friction: its least-squares fit over the joint's usual speeds, at steady
// motion. Nothing of any other effect.
struct FrictionShare {
  double viscous = 0;  // N m s/rad or N s/m
  double coulomb = 0;  // N m or N
};
FrictionShare ShareOfFriction(const CarriedEffect& effect, const Robot& robot,
                              const MotionScale& scale);

}  // namespace armcal
