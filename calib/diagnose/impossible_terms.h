#pragma once

#include <vector>

#include "calib/diagnose/data/audit.h"
#include "calib/diagnose/judge/found_effect.h"
#include "calib/diagnose/judge/moved.h"

namespace armcal {

// What of the terms that the file gives no joint, and that are named as
// lacking, no joint can have: friction or armature that the logs tell to be
// below zero on some joint and above on none. A refit has no bounds, and
// torques whose sign is wrong fit it with such numbers; then nothing that is
// named is there. `moved`: the values that are far from the file's. Changes
// since a reference are no such terms: there may be less of all of them.
std::vector<DataFinding> TellImpossibleTerms(
    const std::vector<FoundEffect>& effects,
    const std::vector<MovedParameter>& moved);

}  // namespace armcal
