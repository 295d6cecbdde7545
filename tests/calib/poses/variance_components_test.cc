// Variances of errors that add up, by draws of known ones.

#include "calib/poses/variance_components.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::variance_components_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kGroups = 40, kInGroup = 3, kFitted = 20;

std::vector<Eigen::Triplet<double>> Groups(int in_group) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < kGroups * kInGroup; ++k) {
    entries.emplace_back(k, k / in_group, 1);
  }
  return entries;
}

MatrixXd Fitted(std::mt19937_64* random) {
  const int rows = kGroups * kInGroup;
  MatrixXd A(rows, kFitted);
  for (double& a : A.reshaped()) a = Normal(random);
  return Eigen::HouseholderQR<MatrixXd>(A).householderQ() *
         MatrixXd::Identity(rows, kFitted);
}

// Errors of their own of variance 1 and of groups of variance 4, of which a fit
// has taken 20 combinations: without that in the equations the estimate of the
// groups' would be a sixth too small.
TEST(VarianceComponents, AreRightInTheMeanWhateverWasFitted) {
  std::mt19937_64 random(3);
  VectorXd mean = VectorXd::Zero(2);
  constexpr int kDraws = 400;
  const MatrixXd Q = Fitted(&random);
  const std::vector<VarianceComponent> components = {
      {Groups(1), kGroups * kInGroup, Q}, {Groups(kInGroup), kGroups, Q}};
  for (int draw = 0; draw < kDraws; ++draw) {
    VectorXd e(kGroups * kInGroup);
    double shared = 0;
    for (int k = 0; k < e.size(); ++k) {
      if (k % kInGroup == 0) shared = 2 * Normal(&random);
      e[k] = shared + Normal(&random);
    }
    mean += VariancesOf(components, e - Q * (Q.transpose() * e)) / kDraws;
  }
  // Of 400 draws, each good to some 0.2 and 1.1.
  EXPECT_NEAR(mean[0], 1, .05);
  EXPECT_NEAR(mean[1], 4, .2);
}

// A variance below 0 is none, and the other then has all of it.
TEST(VarianceComponents, AreNotNegative) {
  const MatrixXd Q = MatrixXd::Zero(kGroups * kInGroup, 0);
  const std::vector<VarianceComponent> components = {
      {Groups(1), kGroups * kInGroup, Q}, {Groups(kInGroup), kGroups, Q}};
  VectorXd e(kGroups * kInGroup);  // nothing in the mean of a group
  for (int k = 0; k < e.size(); ++k) e[k] = k % kInGroup - 1;
  const VectorXd variances = VariancesOf(components, e);
  EXPECT_DOUBLE_EQ(variances[0], 2. / 3);
  EXPECT_EQ(variances[1], 0);
}

// What the fit takes whole says nothing of its variance.
TEST(VarianceComponents, OfWhatIsNotLeftAreNotTold) {
  MatrixXd Q = MatrixXd::Zero(kGroups * kInGroup, 1);
  Q.topRows(kInGroup).setConstant(1 / std::sqrt(kInGroup));
  std::vector<Eigen::Triplet<double>> first_group;
  for (int k = 0; k < kInGroup; ++k) first_group.emplace_back(k, 0, 1);
  VectorXd e(kGroups * kInGroup);
  for (int k = 0; k < e.size(); ++k) e[k] = std::cos(k);
  e -= (Q * (Q.transpose() * e)).eval();
  const VectorXd variances =
      VariancesOf({{Groups(1), kGroups * kInGroup, Q}, {first_group, 1, Q}}, e);
  EXPECT_NEAR(variances[0], e.squaredNorm() / (kGroups * kInGroup - 1), 1e-12);
  EXPECT_EQ(variances[1], 0);
}

}  // namespace armcal::variance_components_test
