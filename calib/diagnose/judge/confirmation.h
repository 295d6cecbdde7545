#pragma once

#include <vector>

#include "calib/diagnose/judge/predicted_chi2.h"

namespace armcal {

// Whether residuals that the model was not fitted to are what an effect says,
// as PredictedChi2 has them.
struct Confirmation {
  double expected = 0;   // chi^2 by which it changes what is predicted
  double explained = 0;  // by which chi^2 is lower with it

  // 1 where the effect is right, 0 where it is half of what it says, -1 where
  // it is not there; near 0 where it is too small to tell.
  double Share() const;
  // Whether the effect would be seen there at all: chi^2 is expected to change
  // by more than its variance per sample.
  bool IsTold() const { return expected > 1; }
};

// Of parts of different samples together: chi squared adds up.
Confirmation SumOf(const std::vector<Confirmation>& parts);
// The share of the part that has least of the effect; 0 of none. A law acts in
// all of them.
double LeastShare(const std::vector<Confirmation>& parts);

// From whitened residuals per joint with and without the effect, each given
// the baseline that was fitted so.
Confirmation Confirm(const PredictedChi2& chi2, const JointRows& without,
                     const JointRows& with);

}  // namespace armcal
