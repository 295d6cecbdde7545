#pragma once

#include <utility>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/screen.h"

namespace armcal {

// Stretches of two seconds, each with its sum: what is common to them is no
// noise. (Segment, number.)
std::pair<int, long> BlockOf(const GapRows::Place& place);

// By how much the scatter of a candidate's gradient exceeds what white noise of
// unit variance would give it: tr(V G^-1) / k, at least 1, V summed over blocks
// of projected columns times the residual that `fit` leaves
// (White 1980; Newey and West 1987). Misfit that is common to all times, and
// noise that is not what it was taken for, make it large; delta chi^2 is to be
// divided by it. What shows in one block only it cannot tell.
double Inflation(const GapScreen& screen, const GapRows& rows,
                 const GapCandidate& candidate, const GapScreen::Fit& fit);

}  // namespace armcal
