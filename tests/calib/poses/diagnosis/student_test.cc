// The scale of multivariate t errors against what its likelihood has to fulfil.

#include "calib/poses/diagnosis/student.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/fixtures/sample_motion.h"

namespace armcal::student_test {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Eigen::VectorXd NormalErrors(int count, double sigma) {
  std::mt19937_64 random(8);
  Eigen::VectorXd r(count);
  for (double& x : r) x = sigma * Normal(&random);
  return r;
}

TEST(Student, OfNormalErrorsIsTheRootMeanSquare) {
  const Eigen::VectorXd r = NormalErrors(300, .01);
  const StudentFit fit = FitStudent(r, 3, kInfinite);
  EXPECT_DOUBLE_EQ(fit.scale, std::sqrt(r.squaredNorm() / 300));
  EXPECT_NEAR(StudentVarianceFactor(r, 3, kInfinite, fit, 30), 300. / 270,
              1e-12);
}

// The derivative of the likelihood by the scale is 0 where
// sum w |r|^2 / s^2 = N d, which makes the mean weight 1.
TEST(Student, MaximisesTheLikelihood) {
  Eigen::VectorXd r = NormalErrors(300, .01);
  r.head(30) *= 50;
  const StudentFit fit = FitStudent(r, 3, 5);
  EXPECT_NEAR(fit.weights.mean(), 1, 1e-6);
  EXPECT_LT(fit.weights.head(10).maxCoeff(), .2);
  EXPECT_LT(fit.deviance, FitStudent(r, 3, kInfinite).deviance);
}

// -2 log p of one error of a standard Cauchy distribution: 2 log(pi (1 + x^2)).
TEST(Student, IsTheCauchyDensityAtOneDegreeOfFreedom) {
  const Eigen::Vector2d r(1, -1);
  const StudentFit fit = FitStudent(r, 1, 1);
  EXPECT_NEAR(fit.scale, 1, 1e-6);  // by symmetry: |x| = s
  EXPECT_NEAR(fit.deviance, 2 * 2 * std::log(2 * M_PI), 1e-6);
}

}  // namespace armcal::student_test
