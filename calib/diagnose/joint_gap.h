#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "calib/diagnose/judge/where.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// What is left given the effects that were found.
struct Unexplained {
  std::string joint;
  std::string organised_by;
  double share = 0;  // of the refitted model's excess over the noise
};

struct JointGap {
  std::string name;
  std::string unit;
  // rms of the held-out torque residual, N m or N; NaN where none was held out.
  double nominal_rms = NAN, refit_rms = NAN, after_rms = NAN, floor_rms = 0;
  double torque_rms = 0;   // of the recorded torque, N m or N
  Organisation organised;  // of the refitted model's residual
  double unexplained = 0;  // chi^2 beyond the noise's after the effects
};

// What no effect explains, in sample: its share of what a refit leaves beyond
// the noise, and the joint that holds most of it.
Unexplained SumUnexplained(const GapFit& fit,
                           const std::vector<JointGap>& joints);

}  // namespace armcal
