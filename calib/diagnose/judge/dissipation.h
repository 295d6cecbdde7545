#pragma once

#include <cstddef>

#include "calib/diagnose/select/fit.h"

namespace armcal {

// Whether with the k-th of the fitted effects friction of some joint gives
// power, viscous or Coulomb friction below 0 by more than three standard
// deviations, and would not without it: no law of an arm does that, and the
// effect stands for something else. The same of an effect that is a joint's
// friction or armature itself and leaves it less than none. Joints on which a
// fitted effect is friction as well are left out: a term below 0 is a part of
// it there. Since a reference nothing is asked, whose laws hold friction, too.
bool MakesFrictionGivePower(const GapFit& fit, size_t k);

}  // namespace armcal
