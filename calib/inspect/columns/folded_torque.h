#pragma once

#include <Eigen/Core>

namespace armcal {

// What a torque that never changes its sign shows near zero, if its values are
// the size of something that has both signs.
struct Folds {
  int visits = 0;    // times that it comes near zero and leaves again
  double share = 0;  // of rows within five times as much of zero, those near it
  // What comes near zero of itself ends on either side of it, each time as
  // likely as not: 2^-visits is the probability that it was never on the other
  // side. `agree` are other things that say so, each by chance as likely as
  // not, too. All together have to be less likely than 1/100 of the columns
  // asked (the sign test). And what goes through zero has as many values in
  // each of five equal bands beside it, a fifth in the first; what rests at
  // zero, or turns there smoothly (sqrt(1/5)), has more, and what ends above it
  // has less (1/25 where the density of values rises linearly from there).
  bool HaveLostSign(int columns, int agree) const;
};

// Of rows in which the joint moves: faster than a fifth of its rms speed.
// Near zero: less than a thirtieth of the torque's rms there; away from it:
// more than five times that.
Folds FindFolds(const Eigen::VectorXd& torque, const Eigen::VectorXd& speed);

}  // namespace armcal
