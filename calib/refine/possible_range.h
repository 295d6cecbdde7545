#pragma once

#include <limits>

#include "calib/numerics/convex_draws.h"
#include "model/robot/inertial_parameters.h"

namespace armcal {

// How far one may go both ways on a line of robots' parameters, at + t * along,
// while robots can exist. What can exist is convex, so that there is one range.
class PossibleRange {
 public:
  // A number that is not negative. `at` is positive.
  void KeepPositive(double at, double along);
  // A link, whose pseudo-inertia is positive definite. `at` is one that is.
  void KeepPossible(const Vector10d& at, const Vector10d& along);

  // A little within what is left, for the rounding at the ends.
  LineRange range() const;

 private:
  LineRange range_ = {-std::numeric_limits<double>::infinity(),
                      std::numeric_limits<double>::infinity()};
};

}  // namespace armcal
