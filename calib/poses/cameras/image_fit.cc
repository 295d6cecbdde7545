#include "calib/poses/cameras/image_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr int kMostPoseSteps = 50, kMostLensSteps = 100;
constexpr double kSettledSquares = 1e-12;  // of the squares, by a step's

double CostOf(const std::vector<ImageErrors>& errors, double stddev) {
  double cost = 0;
  for (const ImageErrors& image : errors) cost += HuberCost(image.r, stddev);
  return cost;
}

}  // namespace

// Levenberg and Marquardt with weights anew in each step: damping grows until
// the cost falls, and shrinks when it does.
bool FitImage(const ImageView& view, const PinholeCamera& camera, double stddev,
              Isometry3d* X_WT) {
  ImageErrors at, tried;
  if (!view.Errors(camera, *X_WT, &at)) return false;
  double damping = 1e-6;
  for (int step = 0; step < kMostPoseSteps && damping < 1e6; ++step) {
    const VectorXd weights = HuberWeights(at.r, stddev);
    Matrix6d A = at.by_pose.transpose() * weights.asDiagonal() * at.by_pose;
    A.diagonal() *= 1 + damping;
    const Vector6d move =
        A.ldlt().solve(-at.by_pose.transpose() * weights.cwiseProduct(at.r));
    const Isometry3d moved = Displaced(*X_WT, move);
    if (!view.Errors(camera, moved, &tried) ||
        HuberCost(tried.r, stddev) > HuberCost(at.r, stddev)) {
      damping = std::max(1e-6, 10 * damping);
      continue;
    }
    const bool settled = (at.by_pose * move).squaredNorm() <=
                         kSettledSquares * at.r.squaredNorm();
    *X_WT = moved, at = tried;
    damping /= 10;
    if (settled) break;
  }
  return true;
}

bool ErrorsOf(const std::vector<ImageView>& views, const PinholeCamera& camera,
              const std::vector<Isometry3d>& X_WT,
              std::vector<ImageErrors>* errors) {
  errors->resize(views.size());
  bool seen = true;
  for (size_t k = 0; k < views.size(); ++k) {
    seen &= views[k].Errors(camera, X_WT[k], &(*errors)[k]);
  }
  return seen;
}

LensEquations EquationsOfLens(const std::vector<ImageErrors>& errors,
                              double stddev) {
  LensEquations e;
  e.information.setZero();
  e.pull.setZero();
  for (const ImageErrors& image : errors) {
    const VectorXd w = HuberWeights(image.r, stddev) / (stddev * stddev);
    const MatrixXd WP = w.asDiagonal() * image.by_pose;
    const MatrixXd WL = w.asDiagonal() * image.by_lens;
    const Matrix6d A = image.by_pose.transpose() * WP;
    const MatrixXd B = image.by_pose.transpose() * WL;
    const MatrixXd moves = -A.llt().solve(B);
    e.information += image.by_lens.transpose() * WL + B.transpose() * moves;
    e.pull -= WL.transpose() * image.r;
    e.A.push_back(A);
    e.moves.push_back(moves);
  }
  return e;
}

// Steps in the eight numbers of the lens alone, since each image finds its own
// pose: all together would be six more unknowns for each image, in a narrow
// valley.
bool FitLens(const std::vector<ImageView>& views, double stddev,
             PinholeCamera* camera, std::vector<Isometry3d>* X_WT) {
  std::vector<ImageErrors> errors, tried;
  const auto settle = [&](const PinholeCamera& lens,
                          std::vector<Isometry3d>* poses,
                          std::vector<ImageErrors>* at) {
    for (size_t k = 0; k < views.size(); ++k) {
      if (!FitImage(views[k], lens, stddev, &(*poses)[k])) return false;
    }
    return ErrorsOf(views, lens, *poses, at);
  };
  if (!settle(*camera, X_WT, &errors)) return false;
  double damping = 1e-6;
  for (int step = 0; step < kMostLensSteps && damping < 1e6; ++step) {
    const LensEquations e = EquationsOfLens(errors, stddev);
    MatrixXd A = e.information;
    A.diagonal() *= 1 + damping;
    const PinholeCamera::Lens move = A.ldlt().solve(e.pull);
    PinholeCamera lens = *camera;
    lens.set_lens(lens.lens() + move);
    std::vector<Isometry3d> poses = *X_WT;
    const bool lower = lens.fx > 0 && lens.fy > 0 &&
                       settle(lens, &poses, &tried) &&
                       CostOf(tried, stddev) <= CostOf(errors, stddev);
    if (!lower) {
      damping = std::max(1e-6, 10 * damping);
      continue;
    }
    *camera = lens, *X_WT = poses, errors = tried;
    damping /= 10;
    const double explained = stddev * stddev * move.dot(e.pull);  // px^2
    if (explained <= kSettledSquares * CostOf(errors, stddev)) break;
  }
  return camera->lens().allFinite();
}

}  // namespace armcal
