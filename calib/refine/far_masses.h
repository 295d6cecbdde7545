#pragma once

#include <string>

#include "calib/refine/nonlinear_calibration.h"

namespace armcal {

// A sentence where links of a robot that was found weigh ten times what the
// file says, or a tenth; empty where none does. A file may be that wrong; a
// maker's hardly is. Gravity or torques whose sign is wrong do that to the best
// of files: of slow motions centres of mass that are mirrored explain them,
// with masses that make up for the links' lengths.
std::string WhatMassesAreFar(const NonlinearCalibration& refined);

}  // namespace armcal
