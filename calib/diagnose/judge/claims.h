#pragma once

#include <vector>

#include "calib/diagnose/judge/found_effect.h"
#include "calib/diagnose/judge/removed_share.h"

namespace armcal {

// Whether there is anything for it to explain: a refit without it leaves no
// less than the noise, as well as that is known, unless held-out data have it
// as well (what is far below white noise is seen all the same; but what swings
// in time has its phase from each log, and is no confirmation); its torque is
// not smaller than what the best of models lack; and where friction of its
// joint is that of another day, it is more than what the form of this has
// wrong.
bool IsNeeded(const FoundEffect& found, double extra_variance);

// Whether it is more than the reference's logs differ by among each other.
bool IsBeyondScatter(const FoundEffect& found);

// Whether held-out data have it as well, in part: by chi^2, or by the interval
// of what it removes where chi^2 would not change.
bool IsSeenAgain(const FoundEffect& found);

// Whether something is there though none of its effects is claimed: held-out
// data have one of them as well, and it does not only mend what others spoiled.
bool IsThereWithoutName(const std::vector<FoundEffect>& effects,
                        const GapFigures& held_out);

// Whether held-out data should show it, and have neither chi^2 lower with it
// nor the mean square for certain (the 95 % interval of its gain). A form that
// is a little too large raises chi^2 alone; and what is small compared to what
// it explained where it was fitted may be what its form has wrong.
bool IsContradicted(const FoundEffect& found);
// Whether data tell any number of an effect: one whose 95 % intervals hold 0
// all has no size, whatever the probability is that regressions give it. A
// frequency or a time is a number, too.
bool HasANumber(const FoundEffect& found);

// Whether it is told as an effect; what is not is a candidate. It has to be
// possible and likelier than not, and likelier still where held-out data do not
// show it; what swings in time has to help there.
bool IsClaimed(const FoundEffect& found);

// Whether it is told that one of a few is there, which data cannot tell apart:
// it or one of its equivalents together would be claimed.
bool IsOneOfFew(const FoundEffect& found);

}  // namespace armcal
