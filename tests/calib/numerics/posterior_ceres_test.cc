// Our covariance against Ceres' on a problem that both can solve.

#include <ceres/covariance.h>
#include <ceres/normal_prior.h>
#include <gtest/gtest.h>

#include "calib/numerics/posterior.h"
#include "calib/poses/fit.h"
#include "calib/poses/pose_solution.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::posterior_ceres_test {

using Eigen::MatrixXd;
using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Poses of a tool with a prior on all of the geometry: everything has a
// variance, though only the prior tells some directions apart.
TEST(PosteriorCeres, IsCeresCovarianceOfAProblemOfFullRank) {
  Plant plant("UR5 6R", 5);
  const PoseMeasurements measured = plant.Measure(Instrument::kPoses, 40, 1e-4);
  PoseCalibrationOptions options;
  options.loss = RobustLoss::kSquared;
  PoseFit fit(plant.nominal, measured, options);
  PoseUnknowns at = SolvePoses(measured, RefineGeometry::kAll, &fit).unknowns;
  const int size = fit.geometry().size();
  MatrixXd weight = MatrixXd::Zero(size, size);
  for (int k = 0; k < size; ++k) {
    weight(k, k) = fit.geometry().Units()[k] == "m" ? 1 / .01 : 1 / .02;
  }

  ceres::Problem problem;
  fit.AddResiduals(fit.AllRows(), &at, &problem);
  problem.AddResidualBlock(new ceres::NormalPrior(weight, at.geometry), nullptr,
                           at.geometry.data());
  ceres::Covariance::Options how;
  how.algorithm_type = ceres::DENSE_SVD;
  how.min_reciprocal_condition_number = 1e-20;
  ceres::Covariance covariance(how);
  const double* const block = at.geometry.data();
  const std::vector<std::pair<const double*, const double*>> blocks = {
      {block, block}};
  ASSERT_TRUE(covariance.Compute(blocks, &problem));
  RowMajor expected(size, size);
  covariance.GetCovarianceBlock(block, block, expected.data());

  std::vector<int> all(size);
  for (int k = 0; k < size; ++k) all[k] = k;
  const MatrixXd ours =
      Posterior(fit.Jacobian(fit.AllRows(), at), weight * weight, all).Gain();
  for (int a = 0; a < size; ++a) {
    for (int b = 0; b < size; ++b) {
      const double scale = std::sqrt(expected(a, a) * expected(b, b));
      EXPECT_NEAR(ours(a, b), expected(a, b), 1e-6 * scale);
    }
  }
}

}  // namespace armcal::posterior_ceres_test
