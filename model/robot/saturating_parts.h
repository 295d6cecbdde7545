#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/robot/joint_drive.h"

namespace armcal {

// A point of a line that begins at (0, 0).
struct Knot {
  double x, force;
};

// Few knots, the line through which follows a curve f at rising x > 0. It is
// Douglas and Peucker's (1973): knots are added where the line is farthest off
// until it is nowhere by more than `tolerance` times the largest |f|. A line
// between points of a bent curve lies to one side of it, which as a force would
// be a bias; so the knots' values are then those of least squares, but for the
// first and the last, which is the curve's end.
std::vector<Knot> FitKnots(const Eigen::ArrayXd& x, const Eigen::ArrayXd& f,
                           double tolerance);

// Without the knots below the smallest line above them that bends only
// downwards.
std::vector<Knot> ConcaveHull(const std::vector<Knot>& knots);

// The line as a sum of parts, one that saturates at each knot x_k but the
// first: where the slope is a_k before and a_(k+1) behind it, behind the last
// one 0, its force is x_k (a_k - a_(k+1)), of either sign.
std::vector<SaturatingPart> PartsOf(const std::vector<Knot>& knots);

// -force tanh((q - centre) / softness), within 1 % of the force.
BoundedSpring TanhSpring(double force, double centre, double softness);

}  // namespace armcal
