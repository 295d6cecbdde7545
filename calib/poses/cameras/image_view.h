#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "model/camera/pinhole_camera.h"
#include "model/log_files/pose_reader.h"

namespace armcal {

// Where the camera is: on the tool, looking at a board that stands (eye in
// hand), or standing, looking at a board on the tool (eye to hand).
enum class CameraPlace { kOnTool, kStanding };

// Pixels' errors of an image, predicted less seen, two a point, and their
// derivatives by a displacement (m) and a rotation (rad) of the tool, both in
// the instrument's frame W, and by the lens (PinholeCamera::kLensNames).
struct ImageErrors {
  Eigen::VectorXd r;        // 2 x points
  Eigen::MatrixXd by_pose;  // 2 x points, 6
  Eigen::MatrixXd by_lens;  // 2 x points, 8
};

// An image of a board's points (m, in its frame). Eye in hand: the tool frame T
// is the camera's, the instrument's frame W the board's; eye to hand: T is the
// board's, W the camera's.
class ImageView {
 public:
  ImageView(const Eigen::Matrix3Xd& points, const Eigen::Matrix2Xd& pixels,
            CameraPlace place)
      : points_(points), pixels_(pixels), place_(place) {}

  // With the tool at X_WT; false where a point is behind the camera.
  bool Errors(const PinholeCamera& camera, const Eigen::Isometry3d& X_WT,
              ImageErrors* errors) const;
  const Eigen::Matrix3Xd& points() const { return points_; }
  const Eigen::Matrix2Xd& pixels() const { return pixels_; }
  CameraPlace place() const { return place_; }

 private:
  const Eigen::Matrix3Xd& points_;
  const Eigen::Matrix2Xd& pixels_;
  CameraPlace place_;
};

// Huber's weights of points' errors r and his cost, for a standard deviation
// (px) of a coordinate.
Eigen::VectorXd HuberWeights(const Eigen::VectorXd& r, double stddev);
double HuberCost(const Eigen::VectorXd& r, double stddev);

// Standard deviation of a coordinate: 1.4826 times the median of all
// coordinates' absolute errors, corrected for `unknowns` of all images.
double PixelDeviation(const std::vector<ImageErrors>& errors, double unknowns);

// X displaced by the first three numbers (m) and turned by the last (rad), both
// in its parent's axes, about its own origin.
Eigen::Isometry3d Displaced(const Eigen::Isometry3d& X,
                            const Eigen::Matrix<double, 6, 1>& by);

}  // namespace armcal
