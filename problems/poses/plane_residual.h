#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/log_files/pose_reader.h"
#include "model/robot/arm_geometry.h"

namespace armcal {

// A plane that the tool's tip touches and whose place nobody knows, as three
// numbers a, b, c (1, 1, m):
//   x_k + a x_i + b x_j = c,  (i, j) the two axes after k in the world's frame,
// where k is the axis to which the plane is most nearly normal.
struct TouchedPlane {
  int axis;  // k

  int first() const { return (axis + 1) % 3; }
  int second() const { return (axis + 2) % 3; }
  Eigen::Vector3d Normal(const double* abc) const;
  // Signed, m.
  double Distance(const double* abc, const Eigen::Vector3d& p) const;
  // d Distance / d (a, b, c).
  Eigen::RowVector3d Derivative(const double* abc,
                                const Eigen::Vector3d& p) const;
};

// Of each touched plane, and its a, b, c (three each), by the tips at the
// geometry's own values: least squares of the distances.
std::vector<TouchedPlane> TouchedPlanes(const ArmGeometry& geometry,
                                        const PoseMeasurements& measured,
                                        Eigen::VectorXd* abc);

// The tip's distance from a plane that it touches:
//   r = Distance(p_WT(q; g)) / sigma     (1).
// Parameter blocks: g, the geometry's parameters; a, b, c of the plane.
class PlaneResidual : public ceres::CostFunction {
 public:
  PlaneResidual(std::shared_ptr<const ArmGeometry> geometry,
                const Eigen::VectorXd& q, const TouchedPlane& plane,
                double sigma);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::shared_ptr<const ArmGeometry> geometry_;
  Eigen::VectorXd q_;
  TouchedPlane plane_;
  double sigma_;
};

}  // namespace armcal
