#include "problems/excitation_criterion.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace armcal::excitation_criterion_test {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

DesignQuantities All(int size) {
  DesignQuantities all{MatrixXd::Identity(size, size),
                       MatrixXd::Zero(size, size),
                       {},
                       VectorXd::Ones(size)};
  for (int k = 0; k < size; ++k) all.wanted.push_back(k);
  return all;
}

double Value(ExcitationCriterion criterion, const DesignQuantities& quantities,
             const MatrixXd& A) {
  MatrixXd gradient;
  return EvaluateCriterion(criterion, quantities, A, &gradient).value();
}

// Information diag(4, 25): standard deviations of 1/2 and 1/5.
TEST(ExcitationCriterion, OfTwoIndependentQuantities) {
  const Matrix2d A = Eigen::Vector2d(4, 25).asDiagonal();
  EXPECT_NEAR(Value(ExcitationCriterion::kD, All(2), A), .5 * std::log(.1),
              1e-14);
  EXPECT_NEAR(Value(ExcitationCriterion::kA, All(2), A),
              .5 * std::log((.25 + .04) / 2), 1e-14);
  EXPECT_NEAR(Value(ExcitationCriterion::kWorst, All(2), A), std::log(.5),
              1e-5);
  EXPECT_TRUE(
      PredictedStddev(All(2), A).isApprox(Eigen::Vector2d(.5, .2), 1e-14));
}

// In other units nothing changes but the unit; what is known counts.
TEST(ExcitationCriterion, ScaleAndKnowledge) {
  DesignQuantities quantities = All(2);
  quantities.known(0, 0) = 5;
  quantities.scale = Eigen::Vector2d(2, 1);
  quantities.wanted = {0, 1};
  const Matrix2d A = Eigen::Vector2d(4, 25).asDiagonal();
  EXPECT_NEAR(Value(ExcitationCriterion::kD, quantities, A),
              .5 * std::log(1. / 6 / 5), 1e-14);
}

// One wanted of two that are mixed: the variance in the full inverse.
TEST(ExcitationCriterion, NuisanceIsAllowedFor) {
  DesignQuantities quantities = All(2);
  quantities.wanted = {1};
  quantities.scale = VectorXd::Ones(1);
  Matrix2d A;
  A << 4, 3, 3, 5;
  for (const auto criterion : {ExcitationCriterion::kD, ExcitationCriterion::kA,
                               ExcitationCriterion::kWorst}) {
    EXPECT_NEAR(Value(criterion, quantities, A), .5 * std::log(4. / 11), 1e-14);
  }
}

TEST(ExcitationCriterion, SingularHasNoValue) {
  Matrix2d A;
  A << 1, 1, 1, 1;
  MatrixXd gradient;
  EXPECT_FALSE(
      EvaluateCriterion(ExcitationCriterion::kD, All(2), A, &gradient));
  EXPECT_TRUE(std::isinf(PredictedStddev(All(2), A)[0]));
}

TEST(ExcitationCriterion, GradientIsItsDerivative) {
  DesignQuantities quantities = All(3);
  quantities.J << 1, .2, 0, .1, 2, .4, 0, 0, .7;
  quantities.known(2, 2) = .3;
  quantities.wanted = {2, 0};
  quantities.scale = Eigen::Vector2d(.4, 3);
  MatrixXd A(3, 3);
  A << 4, 1, .3, 1, 3, .2, .3, .2, 2;
  constexpr double h = 1e-6;
  for (const auto criterion : {ExcitationCriterion::kD, ExcitationCriterion::kA,
                               ExcitationCriterion::kWorst}) {
    MatrixXd gradient;
    EvaluateCriterion(criterion, quantities, A, &gradient);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        MatrixXd step = MatrixXd::Zero(3, 3);
        step(i, j) += h / 2;
        step(j, i) += h / 2;
        EXPECT_NEAR(gradient(i, j),
                    (Value(criterion, quantities, A + step) -
                     Value(criterion, quantities, A - step)) /
                        (2 * h),
                    1e-8);
      }
    }
  }
}

}  // namespace armcal::excitation_criterion_test
