#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/data.h"

namespace armcal {

// What friction adds where it changes sign 1 s later than the recorded velocity
// does, to first order: one joint's in each, whitened; none of joints without
// friction.
std::vector<JointRows> LateFriction(const GapBaseline& baseline,
                                    const GapData& data);

// How much of an effect logs have, and how well they tell it.
struct ShareOfEffect {
  double share = 0;       // 1: all of it
  double delta_chi2 = 0;  // by which chi squared falls with the effect at size

  // Whether what the logs have is of this size, but for what a law may have
  // wrong in its form and for three deviations of chance. What is many times
  // larger is not the effect: most of that is absorbed, as a delay that all
  // logs may share is, and what is left of it, a hundredth of its square, fits
  // the form of something else.
  bool IsOfThisSize() const;
  // Whether they would show all of it by more than chance.
  bool IsTold() const;
  // 2 log of the odds that they have the effect at this size, against that
  // they have none of it: by how much it lowers chi squared. At most 0 where
  // what they have is of another size.
  double odds() const;
  // Whether logs before could have lost what the effect takes away, none of
  // which they have by share -1: they have as much of it at least, but for the
  // same errors.
  bool CouldBeLost() const;
};

// Of an effect at its size in logs. `screen` has their rows, without columns,
// and what is known of the baseline's values besides: a GapData::Screen.
ShareOfEffect ShareIn(const GapBaseline& baseline, const MotionScale& scale,
                      const GapCandidate& effect, GapScreen screen,
                      GapData* data);

}  // namespace armcal
