#include "calib/poses/cameras/camera_poses.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>

#include "calib/poses/cameras/board_start.h"
#include "calib/poses/cameras/lens_start.h"
#include "model/text/format.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;

constexpr double kFirstDeviation = 1e9;  // px: all weigh alike
// Of the focal length, one standard deviation.
constexpr double kKnownLens = .01;

[[noreturn]] void RefuseImage(const ImageSource& source, size_t k) {
  throw InputError(source.file, "row " + std::to_string(source.row[k]), "",
                   "the points of this image do not tell where the board is: "
                   "expected four or more that are not on a line");
}

[[noreturn]] void RefuseLens(const ImageSource& source,
                             const std::string& found) {
  throw InputError(source.file, "row " + std::to_string(source.row[0]), found,
                   "these images do not tell the camera's lens: expected ten "
                   "or more of a board that is turned about two axes, or the "
                   "camera's intrinsics");
}

// Near where the images say the tool is.
std::vector<Isometry3d> Starts(const ImageSource& source,
                               const std::vector<ImageView>& views,
                               const PinholeCamera& camera) {
  std::vector<Isometry3d> X_WT;
  for (size_t k = 0; k < views.size(); ++k) {
    Matrix2Xd directions = views[k].pixels();
    for (Eigen::Index i = 0; i < directions.cols(); ++i) {
      directions.col(i) = camera.Normalised(views[k].pixels().col(i));
    }
    const std::optional<Isometry3d> X_CB =
        StartOfBoard(views[k].points(), directions);
    if (!X_CB) RefuseImage(source, k);
    const bool stands = views[k].place() == CameraPlace::kStanding;
    X_WT.push_back(stands ? *X_CB : X_CB->inverse());
  }
  return X_WT;
}

// Of the poses, the lens known.
void SetCovariance(const LensEquations& equations, CameraPoses* result) {
  for (const Matrix6d& A : equations.A) {
    result->covariance.push_back(A.llt().solve(Matrix6d::Identity()));
  }
}

void AddLens(const ImageSource& source, const LensEquations& equations,
             CameraPoses* result) {
  const MatrixXd& S = equations.information;
  const Eigen::VectorXd size = S.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<MatrixXd> llt(size.asDiagonal() * S * size.asDiagonal());
  if (llt.info() != Eigen::Success) RefuseLens(source, "");
  result->lens_covariance = size.asDiagonal() *
                            llt.solve(MatrixXd::Identity(S.rows(), S.cols())) *
                            size.asDiagonal();
  for (int k = 0; k < 2; ++k) {
    const double share =
        std::sqrt(result->lens_covariance(k, k)) / result->camera.lens()[k];
    if (share < kKnownLens) continue;
    RefuseLens(source,
               Format("a focal length that they tell to %.2g %%", 100 * share));
  }
  for (const auto& moves : equations.moves) result->by_lens.push_back(moves);
}

}  // namespace

// Twice: first with all points alike, which tells the pixels' noise by a
// median, then with Huber's weights for that noise.
CameraPoses PosesOfImages(const ImageSource& source,
                          const std::vector<ImageView>& views,
                          const PinholeCamera& camera) {
  CameraPoses result;
  result.camera = camera;
  result.X_WT = Starts(source, views, camera);
  std::vector<ImageErrors> errors;
  for (const bool robust : {false, true}) {
    const double stddev = robust ? result.pixel_stddev : kFirstDeviation;
    for (size_t k = 0; k < views.size(); ++k) {
      if (!FitImage(views[k], camera, stddev, &result.X_WT[k])) {
        RefuseImage(source, k);
      }
    }
    ErrorsOf(views, camera, result.X_WT, &errors);
    result.pixel_stddev =
        PixelDeviation(errors, 6 * static_cast<double>(views.size()));
  }
  SetCovariance(EquationsOfLens(errors, result.pixel_stddev), &result);
  return result;
}

// The same with the lens unknown. The lens's errors are common to all poses:
// they are handed on (by_lens) as unknowns of the instrument and not as noise
// of each pose.
CameraPoses PosesAndLensOfImages(const ImageSource& source,
                                 const std::vector<ImageView>& views,
                                 const PinholeCamera* start) {
  const std::optional<PinholeCamera> closed =
      start != nullptr ? *start : StartOfLens(views);
  if (!closed) RefuseLens(source, "");
  CameraPoses result;
  result.camera = *closed;
  result.X_WT = Starts(source, views, *closed);
  std::vector<ImageErrors> errors;
  for (const bool robust : {false, true}) {
    const double stddev = robust ? result.pixel_stddev : kFirstDeviation;
    if (!FitLens(views, stddev, &result.camera, &result.X_WT) ||
        !ErrorsOf(views, result.camera, result.X_WT, &errors)) {
      RefuseLens(source, "");
    }
    result.pixel_stddev =
        PixelDeviation(errors, 6 * static_cast<double>(views.size()) +
                                   PinholeCamera::kLensSize);
  }
  const LensEquations equations = EquationsOfLens(errors, result.pixel_stddev);
  SetCovariance(equations, &result);
  AddLens(source, equations, &result);
  return result;
}

}  // namespace armcal
