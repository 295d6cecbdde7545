#include "calib/diagnose/candidates/joint_scatter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/fixtures/sample_motion.h"

namespace armcal::joint_scatter_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kJoints = 6, kRows = 200;

// One parameter that all joints have, and one of the first alone.
RowMajorMatrix Slopes() {
  RowMajorMatrix J(kJoints * kRows, 2);
  for (int i = 0; i < J.rows(); ++i) {
    J.row(i) << std::sin(.1 * i), i < kRows ? std::cos(.07 * i) : 0;
  }
  return J;
}

// Noise, and a value of each joint's own about the common one.
VectorXd Left(double scatter, std::mt19937_64* random) {
  const RowMajorMatrix J = Slopes();
  VectorXd y(J.rows());
  for (int j = 0; j < kJoints; ++j) {
    const double own = scatter * Normal(random);
    for (int i = j * kRows; i < (j + 1) * kRows; ++i) {
      y[i] = own * J(i, 0) + Normal(random);
    }
  }
  return y - J * J.colPivHouseholderQr().solve(y);
}

std::vector<int> Joints() {
  std::vector<int> joints(kJoints * kRows);
  for (int i = 0; i < kJoints * kRows; ++i) joints[i] = i / kRows;
  return joints;
}

MatrixXd Told(double scatter, const std::vector<int>& which,
              std::mt19937_64* random) {
  const RowMajorMatrix J = Slopes();
  const MatrixXd noise = (J.transpose() * J).inverse();
  return WidenByJoints(noise, J, Left(scatter, random), Joints(), which);
}

// The mean of joints whose own values scatter by s is off by s / sqrt(n).
TEST(JointScatter, OfDisagreeingJointsIsThatOfTheirMean) {
  constexpr double kScatter = 2;
  constexpr int kDraws = 300;
  std::mt19937_64 random(3);
  double variance = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    variance += Told(kScatter, {0}, &random)(0, 0) / kDraws;
  }
  EXPECT_NEAR(std::sqrt(variance), kScatter / std::sqrt(kJoints),
              .1 * kScatter / std::sqrt(kJoints));
}

// Variances are never less than told, and correlations stay.
TEST(JointScatter, WidensWhatIsOfAllJoints) {
  std::mt19937_64 random(4);
  const RowMajorMatrix J = Slopes();
  const MatrixXd noise = (J.transpose() * J).inverse();
  const MatrixXd wide = Told(2, {0}, &random);
  EXPECT_GT(wide(0, 0), 10 * noise(0, 0));
  EXPECT_EQ(wide(1, 1), noise(1, 1));
  EXPECT_NEAR(wide(0, 1) / std::sqrt(wide(0, 0) * wide(1, 1)),
              noise(0, 1) / std::sqrt(noise(0, 0) * noise(1, 1)), 1e-12);
  EXPECT_EQ(Told(2, {}, &random), noise);
  // The other one is of one joint, which cannot disagree.
  EXPECT_EQ(Told(2, {1}, &random)(1, 1), noise(1, 1));
}

}  // namespace armcal::joint_scatter_test
