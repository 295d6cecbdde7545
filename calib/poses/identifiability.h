#pragma once

#include <string>
#include <vector>

#include "calib/poses/fit.h"

namespace armcal {

// Of the parameters that are wanted, those that the poses `rows` can tell
// apart: of several that they cannot the first is kept, the instrument's, then
// joint zeros, then the others in the order of the arm. *held (null: unasked)
// says of each of the others why it is not.
std::vector<bool> HoldUnseen(const PoseFit& fit,
                             const std::vector<bool>& wanted,
                             const std::vector<int>& rows,
                             const PoseUnknowns& at,
                             std::vector<std::string>* held);

// The length that stands for the scale, which touches do not tell: with a tenth
// of all lengths a tip would touch as well, so that the longest of the arm's
// that are wanted says how long a metre is. -1: something else does.
int ScaleLength(const PoseFit& fit, const std::vector<bool>& wanted);

}  // namespace armcal
