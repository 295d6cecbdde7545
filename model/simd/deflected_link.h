#pragma once

namespace armcal::simd {

// A link behind a FlankedSpring (model/flanked_spring.h) along a log, as the
// kernel reads it:  inertia d'' + T(d, d') = load.
struct DeflectedLink {
  double gap, stiffness, damping;
  const double* load;     // N m or N, of each sample
  const double* inertia;  // kg m^2 or kg
  double start, start_rate;
  int substeps;  // per half a sample
  // Of each sample: d, d', and d'' as its mean over the sample.
  double* angle;
  double* rate;
  double* acceleration;
};

}  // namespace armcal::simd
