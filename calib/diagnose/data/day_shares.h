#pragma once

#include <array>
#include <utility>

#include "model/dynamics/joint_term.h"

namespace armcal {

// Scatter of friction from one day to the next, shares of it: a UR10e's in
// eight logs of a month (shared/data/ur10e_free/SOURCE.md), ranges over 2.85.
inline constexpr std::array<std::pair<JointTerm, double>, 2> kShareOfDays = {
    {{JointTerm::kViscous, .1}, {JointTerm::kCoulomb, .06}}};

}  // namespace armcal
