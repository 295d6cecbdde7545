#pragma once

#include <vector>

#include "calib/diagnose/judge/found_effect.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// What several laws have in common. Laws of one joint that data cannot tell
// apart may all have one and the same mean (Effect::means): whichever of them
// it is, that has changed. The probability of the mean is then the sum of
// theirs, which exclude each other.

// The same finding as that of the mean, if it or one of its `equivalent` is
// that: of the one for which the sum is largest, where there are several. The
// others stay its equivalents, with their own probabilities. Itself where there
// is none, or where a law and its mean are fitted beside each other.
FoundEffect AsSharedMean(const FoundEffect& found);

// Puts what is found in the place of what was fitted for it where AsSharedMean
// made it another effect. Whether there was one; the fit is still to be made.
bool PutMeansInPlace(const std::vector<FoundEffect>& effects, GapFit* fit);

}  // namespace armcal
