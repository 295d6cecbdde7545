#pragma once

#include <cstddef>

#include "calib/diagnose/select/fit.h"

namespace armcal {

// How far joints are from telling the k-th effect of a fit alike, if it is of
// all of them: of chi^2, by what each would rather have it, rows whitened as
// the evidence is,
//   sum_j r_j' P_j (P_j' P_j)^-1 P_j' r_j,
// r_j joint j's residual beside all effects, P_j its rows of this one's
// columns, the baseline free. `freedom`: of the chi squared that this is where
// joints agree; 0 where one joint alone tells.
struct Disagreement {
  double chi_squared = 0;
  int freedom = 0;

  // Whether it is more than chance (three standard deviations), and than
  // `form`: what of the effect's drop of chi^2 its form may have wrong.
  bool IsReal(double drop, double form) const;
};

Disagreement DisagreementOf(const GapFit& fit, size_t k);

}  // namespace armcal
