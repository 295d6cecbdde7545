#pragma once

namespace armcal::simd {

// A link behind a FlankedSpring (model/dynamics/flanked_spring.h) along a log,
// as the kernel reads it (model/dynamics/deflection.h):
//   inertia d'' + damping d' + stiffness d + T(d, d') = load.
struct DeflectedLink {
  // Each as those before it, but that takes more work: a linear spring has a
  // step in closed form.
  enum class Kind { kLinear, kStiffening, kFlanked };
  Kind kind() const {
    if (gap > 0) return Kind::kFlanked;
    return stiffening != 0 ? Kind::kStiffening : Kind::kLinear;
  }

  double gap, stiffness, damping, stiffening;  // of the spring
  struct {
    const double *load, *stiffness, *damping, *inertia;
  } along;  // of each sample
  double start, start_rate;
  int substeps;  // per half a sample
  // Of each sample: d, d', and d'' as its mean over the sample.
  double* angle;
  double* rate;
  double* acceleration;
};

}  // namespace armcal::simd
