#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "calib/poses/cameras/image_view.h"

namespace armcal {

// Moves *X_WT to the pose that minimises an image's errors, by Levenberg and
// Marquardt with Huber's weights for a standard deviation of `stddev` px;
// whether it ends with all points before the camera.
bool FitImage(const ImageView& view, const PinholeCamera& camera, double stddev,
              Eigen::Isometry3d* X_WT);

// What images of one camera say of its lens, each at its best pose: the poses
// are eliminated (Schur's complement of the normal equations
//   [A_k B_k; B_k' C_k], A_k = P'WP, B_k = P'WL, C_k = L'WL,
// P and L an image's derivatives by pose and lens, W Huber's weights over the
// variance).
struct LensEquations {
  Eigen::Matrix<double, PinholeCamera::kLensSize, PinholeCamera::kLensSize>
      information;           // sum C_k - B_k' A_k^-1 B_k
  PinholeCamera::Lens pull;  // - sum L'W r
  std::vector<Matrix6d> A;   // of each pose, the lens known
  // How a unit of each of the lens's parameters moves the pose, -A_k^-1 B_k.
  std::vector<Eigen::Matrix<double, 6, PinholeCamera::kLensSize>> moves;
};
LensEquations EquationsOfLens(const std::vector<ImageErrors>& errors,
                              double stddev);

// Moves lens and poses to where they minimise the errors of all images: steps
// of Levenberg and Marquardt of the lens, at each of which every image finds
// its best pose (Golub and Pereyra 1973, variable projection). False where they
// end nowhere.
bool FitLens(const std::vector<ImageView>& views, double stddev,
             PinholeCamera* camera, std::vector<Eigen::Isometry3d>* X_WT);

// Errors of all images; false where a point is behind the camera.
bool ErrorsOf(const std::vector<ImageView>& views, const PinholeCamera& camera,
              const std::vector<Eigen::Isometry3d>& X_WT,
              std::vector<ImageErrors>* errors);

}  // namespace armcal
