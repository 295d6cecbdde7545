#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/motion_scale.h"

namespace armcal {

// A parameter as Ceres sees it: p = centre + scale (u - 1), or
// centre exp(scale (u - 1)) where it is a size that grows by factors. It starts
// at u = 1, since numeric derivatives step by a share of u.
struct Coordinate {
  int effect;
  int parameter;
  double centre;
  double scale;
  bool by_factors = false;
  double low = -std::numeric_limits<double>::infinity();  // of p
  double high = std::numeric_limits<double>::infinity();

  double Value(double u) const {
    if (u == Inverse(low)) return low;
    if (u == Inverse(high)) return high;
    return by_factors ? centre * std::exp(scale * (u - 1))
                      : centre + scale * (u - 1);
  }
  double Slope(double u) const { return by_factors ? scale * Value(u) : scale; }
  double Inverse(double p) const {
    return by_factors ? 1 + std::log(p / centre) / scale
                      : 1 + (p - centre) / scale;
  }
  // Whether u is at a bound beyond which a cost of this slope would fall.
  bool IsHeld(double u, double slope) const {
    return (std::isfinite(low) && u <= Inverse(low) && slope > 0) ||
           (std::isfinite(high) && u >= Inverse(high) && slope < 0);
  }
  // Of u, which solvers put exactly there; p is rounded.
  bool AtBound(double u) const {
    return (std::isfinite(low) && u <= Inverse(low)) ||
           (std::isfinite(high) && u >= Inverse(high));
  }
};

// The parameters that vary of effect `only`, or of all where that is -1.
std::vector<Coordinate> ListCoordinates(
    const GapBaseline& baseline, const MotionScale& scale,
    const std::vector<GapCandidate>& effects, int only);

}  // namespace armcal
