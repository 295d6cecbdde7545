#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace armcal {

// A board's points about their mean along the axes of their spread, the
// smallest last.
struct BoardAxes {
  explicit BoardAxes(const Eigen::Matrix3Xd& points);  // m
  Eigen::Vector3d mean;
  Eigen::Matrix3d axes;
  Eigen::Matrix3Xd own;
  double size;   // m, rms along the widest axis
  bool is_flat;  // in a plane to a thousandth of that
};

// The 3 x (d + 1) matrix P with x ~ P (s, 1) for points s (d x points) that are
// seen at x (2 x points): the direct linear transformation (Hartley and
// Zisserman 2004, 4.1). Of points of a plane it is their homography. Nothing
// where the points do not tell it: they are on a line.
std::optional<Eigen::MatrixXd> Projection(const Eigen::MatrixXd& points,
                                          const Eigen::Matrix2Xd& seen);

// The pose X_CB of a board in the camera's frame near where its points are seen
// in `directions` (x / z, y / z): of the homography or, where the points are in
// no plane, of the 12 entries of the projection. Nothing where the points do
// not tell it.
std::optional<Eigen::Isometry3d> StartOfBoard(
    const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& directions);

}  // namespace armcal
