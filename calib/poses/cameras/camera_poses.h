#pragma once

#include <string>
#include <vector>

#include "calib/poses/cameras/image_fit.h"
#include "calib/poses/cameras/image_view.h"

namespace armcal {

// The tool's poses X_WT in images of one camera (image_view.h), each with the
// covariance of its errors (m, rad, in W), the lens known: an image tells a
// pose as well as all its pixels do, since these are many and their errors
// small.
struct CameraPoses {
  PinholeCamera camera;
  double pixel_stddev = 0;  // px, of a coordinate
  std::vector<Eigen::Isometry3d> X_WT;
  std::vector<Matrix6d> covariance;
  // Where the lens is estimated, too: the covariance of its parameters, and how
  // a unit of each moves a pose (6 x kLensSize). Empty where it is known.
  Eigen::MatrixXd lens_covariance;
  std::vector<Eigen::MatrixXd> by_lens;
};

// Where these images are: the file, for messages, and each image's line.
struct ImageSource {
  std::string file;
  std::vector<long> row;
};

// With the lens as it is in `camera`. Throws InputError where an image's points
// do not tell a pose (on a line, in the camera's plane).
CameraPoses PosesOfImages(const ImageSource& source,
                          const std::vector<ImageView>& views,
                          const PinholeCamera& camera);
// With the lens estimated from the images, beginning with `start` or in closed
// form (lens_start.h). Throws InputError also where the images do not tell the
// focal length to a hundredth: second orders of what they leave open, a
// ten-thousandth of the distance, then are as large as the errors of poses.
CameraPoses PosesAndLensOfImages(const ImageSource& source,
                                 const std::vector<ImageView>& views,
                                 const PinholeCamera* start);

}  // namespace armcal
