#pragma once

#include "model/robot/inertial_parameters.h"

namespace armcal {

// How the inertia of a link and all that moves with it is shared out among the
// links of a file, all about one origin and in one frame.
struct InertiaSplit {
  InertialParameters head;  // of the link itself
  bool fixed_keep = true;   // what is fixed to it keeps the file's, or has
                            // none and `head` has all
  double held_share = 1;    // what held joints move has that much of the
                            // file's mass and inertia
};

// Shares out `total` where the file says `fixed` of the links that are fixed to
// the head and `held` of those that joints which are held put there. All shares
// sum to `total`, exactly. Fixed links keep theirs where the head can exist
// with what is left, else give it up, which no motion shows. Held links are
// bodies of their own as soon as their joints move, and keep theirs where that
// is possible. Else they have the largest share s that leaves the head
// physically consistent with a margin: with the pseudo-inertias P, which are
// linear,
//   P(total) - s P(held) >= 0  as long as  s lambda_max <= 1,
// lambda_max being the largest eigenvalue of P(total)^-1 P(held) (Wensing, Kim
// & Slotine 2018 have P); s = 0.9 / lambda_max. Where `total` itself is not
// inside what can exist nothing helps, and the head has what is left.
InertiaSplit SplitInertia(const InertialParameters& total,
                          const InertialParameters& fixed,
                          const InertialParameters& held);

}  // namespace armcal
