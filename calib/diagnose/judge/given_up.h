#pragma once

#include <vector>

#include "calib/diagnose/judge/findings.h"
#include "calib/diagnose/judge/removed_share.h"

namespace armcal {

// What was claimed by what the fit and its rivals say, and helps too little on
// held-out data. To give up is to take one effect at most from the claims, as
// the others are to be fitted and judged without it, and to put it first among
// what is not named.

// Where held-out data show that the effects remove less than half of the gap
// (short logs do not: their intervals are wide), most of it has another cause,
// which they may be confused with. Where they perhaps remove nothing, none is
// claimed, else none that is not as likely as what held-out data do not show
// has to be. Gives up the one that removes least, of those first that chi^2
// does not see in held-out data: it sees, of the law of another cause, what is
// alike in both; the mean square sees the rest. Without a reference the gap is
// of what a refit leaves, which may have taken up what is the effects': then
// only what chi^2 does not see, and the mean square sees against, is given up.
// Whether there was one.
bool GiveUpWorst(const GapFigures& torque, bool since_reference,
                 GapFindings* findings);

// Gives up the first fitted effect whose estimates no real arm can have
// (Effect::plausible) now that it is fitted beside what is claimed alone: it is
// at most as likely as not. Whether there was one.
bool GiveUpImpossible(GapFindings* findings);

// What leaves no less of held-out data, though it would (EffectGain::IsNone),
// where a refit leaves more than the noise of them, is not seen there: it is at
// most as likely as not. (Where a refit leaves the noise, they cannot tell.)
void LowerWhatDoesNotHelp(const GapFigures& torque,
                          std::vector<FoundEffect>* effects);

// Of these, where what all claimed effects remove is known to be little, the
// one that helps least is given up. Whether there was one.
bool GiveUpWhatDoesNotHelp(const GapFigures& torque, GapFindings* findings);

}  // namespace armcal
