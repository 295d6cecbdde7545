#include "calib/diagnose/data/screen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "tests/fixtures/sample_motion.h"

namespace armcal::screen_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kBaseline = 5;
constexpr double kTight = 1e-7;

VectorXd RandomVector(std::mt19937_64* random, int size) {
  VectorXd x(size);
  for (double& value : x) value = Normal(random);
  return x;
}

MatrixXd RandomMatrix(std::mt19937_64* random, int rows, int cols) {
  return RandomVector(random, rows * cols).reshaped(rows, cols);
}

// A regression that is small enough to be solved as a whole, by QR.
class GapScreenTest : public testing::Test {
 protected:
  GapScreenTest() {
    for (const int rows : {40, 30}) {
      baseline_.push_back(RandomMatrix(&random_, rows, kBaseline));
      target_.push_back(3 * RandomVector(&random_, rows));
    }
    columns_ = {{RandomVector(&random_, 40), RandomVector(&random_, 30)},
                {RandomVector(&random_, 40), VectorXd()},
                {VectorXd(), RandomVector(&random_, 30)}};
  }

  GapScreen Screen() const {
    GapScreen screen(OnEachJoint(baseline_), kBaseline, target_);
    for (const JointRows& column : columns_) screen.AddColumn(column);
    screen.Factor();
    return screen;
  }
  // All rows, the prior's and other data's at the end.
  void Stack(const std::vector<int>& which, MatrixXd* A, VectorXd* y) const {
    const int size = kBaseline + static_cast<int>(which.size());
    A->setZero(70 + kBaseline + other_A_.rows(), size);
    y->setZero(A->rows());
    *A << Rows(0, which), Rows(1, which), MatrixXd::Identity(kBaseline, size),
        MatrixXd(other_A_.rows(), size).setZero();
    A->bottomLeftCorner(other_A_.rows(), other_A_.cols()) = other_A_;
    y->head(70) << target_[0], target_[1];
    y->tail(other_y_.size()) = other_y_;
  }
  MatrixXd Rows(int joint, const std::vector<int>& which) const {
    MatrixXd A = MatrixXd::Zero(target_[joint].size(),
                                kBaseline + static_cast<int>(which.size()));
    A.leftCols(kBaseline) = baseline_[joint];
    for (size_t k = 0; k < which.size(); ++k) {
      const VectorXd& column = columns_[which[k]][joint];
      if (column.size() > 0) A.col(kBaseline + k) = column;
    }
    return A;
  }
  VectorXd Estimate(const std::vector<int>& which, double* chi_squared) const {
    MatrixXd A;
    VectorXd y;
    Stack(which, &A, &y);
    const VectorXd x = A.colPivHouseholderQr().solve(y);
    *chi_squared = (y - A * x).squaredNorm();
    return x;
  }

  // Other data that fit them exactly.
  void SeeThreeDirections(double size) {
    other_A_ = size * RandomMatrix(&random_, 3, kBaseline);
    other_y_ = 2 * size * RandomVector(&random_, 3);
  }
  void ExpectTheJointResidual(double tolerance) const {
    GapScreen screen(OnEachJoint(baseline_), kBaseline, target_);
    screen.AddKnown(OnEachJoint({other_A_}), {other_y_});
    screen.Factor();
    double chi_squared;
    Estimate({}, &chi_squared);
    EXPECT_NEAR(screen.ResidualGiven(JointRows(2)).squaredNorm(), chi_squared,
                tolerance * chi_squared);
  }

  std::mt19937_64 random_{1};
  std::vector<MatrixXd> baseline_;
  JointRows target_;
  std::vector<JointRows> columns_;
  MatrixXd other_A_{0, kBaseline};
  VectorXd other_y_{VectorXd(0)};
};

TEST_F(GapScreenTest, ColumnsMayComeLater) {
  GapScreen screen(OnEachJoint(baseline_), kBaseline, target_);
  for (const JointRows& column : columns_) {
    screen.Factor();
    screen.AddColumn(column);
  }
  screen.Factor();
  double none, chi_squared;
  Estimate({}, &none);
  Estimate({0, 1, 2}, &chi_squared);
  EXPECT_NEAR(screen.Solve({0, 1, 2}).delta_chi2, none - chi_squared,
              kTight * none);
}

// A column's product with what the baseline leaves of a part of the target.
TEST_F(GapScreenTest, GradientsAreOfPartsOfATarget) {
  std::vector<std::vector<int>> part = {std::vector<int>(40, 2),
                                        std::vector<int>(30, 0)};
  std::fill(part[0].begin() + 10, part[0].begin() + 25, 0);
  const MatrixXd g = Screen().Gradients(target_, part, 3);
  for (int p = 0; p < 3; ++p) {
    JointRows own = target_;
    for (int j = 0; j < 2; ++j) {
      for (int k = 0; k < own[j].size(); ++k) own[j][k] *= part[j][k] == p;
    }
    std::swap(target_, own);
    for (int c = 0; c < 3; ++c) {
      double none, chi_squared;
      Estimate({}, &none);
      const VectorXd x = Estimate({c}, &chi_squared);
      // chi^2 falls by x times the gradient.
      EXPECT_NEAR(x[kBaseline] * g(c, p), none - chi_squared, kTight * 1e3)
          << p << " " << c;
    }
    std::swap(target_, own);
  }
}

TEST_F(GapScreenTest, IsLeastSquaresWithThePriorsRows) {
  const GapScreen screen = Screen();
  double none, chi_squared;
  Estimate({}, &none);
  for (const std::vector<int>& which :
       std::vector<std::vector<int>>{{0}, {1}, {2, 0}, {0, 1, 2}}) {
    SCOPED_TRACE(testing::Message() << which.size() << " from " << which[0]);
    const VectorXd x = Estimate(which, &chi_squared);
    const GapScreen::Fit fit = screen.Solve(which);
    EXPECT_NEAR(fit.delta_chi2, none - chi_squared, kTight * none);
    EXPECT_TRUE(fit.coefficients.isApprox(x.tail(which.size()), kTight));
    EXPECT_TRUE(screen.Baseline(fit).isApprox(x.head(kBaseline), kTight));
    MatrixXd A;
    VectorXd y;
    Stack(which, &A, &y);
    const MatrixXd covariance = (A.transpose() * A).inverse();
    EXPECT_TRUE(fit.covariance.isApprox(
        covariance.bottomRightCorner(which.size(), which.size()), kTight));
    const VectorXd left = y - A * x;
    EXPECT_TRUE(screen.Residual(0, fit).isApprox(left.head(40), kTight));
    EXPECT_TRUE(screen.Residual(1, fit).isApprox(left.segment(40, 30), kTight));
  }
  EXPECT_EQ(screen.Solve({}).delta_chi2, 0);
}

TEST_F(GapScreenTest, BaselinesCovarianceIsOfTheBaselineAlone) {
  MatrixXd A;
  VectorXd y;
  Stack({}, &A, &y);
  EXPECT_TRUE(Screen().BaselineCovariance().isApprox(
      (A.transpose() * A).inverse(), kTight));
}

// Knowing a log's A'A and A'y is having its rows.
TEST_F(GapScreenTest, InformationIsAsGoodAsTheRowsItIsOf) {
  other_A_ = RandomMatrix(&random_, 25, kBaseline);
  other_y_ = 2 * RandomVector(&random_, 25);
  GapScreen screen(OnEachJoint(baseline_), kBaseline, target_);
  screen.AddKnown(OnEachJoint({other_A_.topRows(9), other_A_.bottomRows(16)}),
                  {other_y_.head(9), other_y_.tail(16)});
  for (const JointRows& column : columns_) screen.AddColumn(column);
  screen.Factor();
  double none, with;
  const VectorXd alone = Estimate({}, &none);
  const VectorXd x = Estimate({0, 1}, &with);
  const GapScreen::Fit fit = screen.Solve({0, 1});
  EXPECT_NEAR(fit.delta_chi2, none - with, kTight * none);
  EXPECT_TRUE(fit.coefficients.isApprox(x.tail(2), kTight));
  EXPECT_TRUE(screen.Baseline(fit).isApprox(x.head(kBaseline), kTight));
  EXPECT_TRUE(screen.BaselineGiven(JointRows(2)).isApprox(alone, kTight));
}

TEST_F(GapScreenTest, ResidualGivenATorqueHasChiSquaredAsItsNorm) {
  const GapScreen screen = Screen();
  const JointRows torque = {VectorXd(), .5 * RandomVector(&random_, 30)};
  target_[1] -= torque[1];
  double chi_squared;
  const VectorXd x = Estimate({}, &chi_squared);
  EXPECT_TRUE(screen.BaselineGiven(torque).isApprox(x, kTight));
  EXPECT_NEAR(screen.ResidualGiven(torque).squaredNorm(), chi_squared,
              kTight * chi_squared);
}

// But for what the other data's own noise leaves, whatever the torque is.
TEST_F(GapScreenTest, ResidualGivenATorqueHoldsOtherDatasShare) {
  SeeThreeDirections(1);
  ExpectTheJointResidual(1e-5);
}

// However sure they are of the directions that they see (a long log beside
// noise that is small): nothing of the others is theirs.
TEST_F(GapScreenTest, ResidualGivenATorqueKnowsWhatOtherDataDoNotSee) {
  for (int k = 0; k < 20; ++k) {
    SeeThreeDirections(1e5);
    ExpectTheJointResidual(1e-3);
  }
}

// What the baseline spans is not to be seen in the data, what is orthogonal to
// it is seen as a whole.
TEST_F(GapScreenTest, VisibleIsWhatTheBaselineCannotTake) {
  for (MatrixXd& A : baseline_) A *= 1e4;  // a prior that says nothing
  JointRows inside, outside;
  const VectorXd mixture = RandomVector(&random_, kBaseline);
  MatrixXd all(70, kBaseline);
  all << baseline_[0], baseline_[1];
  VectorXd free = RandomVector(&random_, 70);
  free -= all * all.colPivHouseholderQr().solve(free);
  for (int j = 0; j < 2; ++j) {
    inside.push_back(baseline_[j] * mixture);
    outside.push_back(free.segment(40 * j, target_[j].size()));
  }
  columns_ = {inside, outside};
  const GapScreen screen = Screen();
  EXPECT_LT(screen.visible(0), 1e-6);
  EXPECT_NEAR(screen.visible(1), 1, 1e-6);
  EXPECT_NEAR(screen.raw(1), free.squaredNorm(), kTight * free.squaredNorm());
  EXPECT_LT(screen.Solve({0}).coefficients.norm(), 1);
}

// As if rows had come with other weights.
TEST_F(GapScreenTest, WeighedRowsAreThoseOfALargerNoise) {
  const VectorXd factor = Eigen::Vector2d(.4, 2.5);
  GapScreen weighed = Screen();
  weighed.Weigh(factor);
  for (int j = 0; j < 2; ++j) {
    baseline_[j] *= factor[j];
    target_[j] *= factor[j];
    for (JointRows& column : columns_) column[j] *= factor[j];
  }
  const GapScreen expected = Screen();
  EXPECT_LT((weighed.G() - expected.G()).norm(), kTight);
  EXPECT_LT((weighed.g() - expected.g()).norm(), kTight);
  EXPECT_LT((weighed.Residual(1, weighed.Solve({0, 2})) -
             expected.Residual(1, expected.Solve({0, 2})))
                .norm(),
            kTight);
}

TEST_F(GapScreenTest, SomeColumnsAreAsIfThereWereNoOthers) {
  const GapScreen only = Screen().Only({2, 0});
  columns_ = {columns_[2], columns_[0]};
  const GapScreen expected = Screen();
  EXPECT_LT((only.G() - expected.G()).norm(), kTight);
  EXPECT_NEAR(only.Solve({0, 1}).delta_chi2, expected.Solve({0, 1}).delta_chi2,
              kTight);
}

// Of columns that are k times as large a value with the same prior makes k
// times as much.
TEST_F(GapScreenTest, BaselinesAreAsUncertainAsTheirColumnsAreLarge) {
  GapScreen scaled = Screen();
  scaled.ScaleBaseline({3, 4}, .2);
  for (MatrixXd& A : baseline_) A.rightCols(2) *= .2;
  const GapScreen expected = Screen();
  EXPECT_LT((scaled.G() - expected.G()).norm(), kTight);
  EXPECT_LT((scaled.g() - expected.g()).norm(), kTight);
  EXPECT_NEAR(scaled.LogDeterminant({}), expected.LogDeterminant({}), kTight);
}

// The first columns alone, as by least squares without the others.
TEST_F(GapScreenTest, TheFirstColumnsMayBeFittedAlone) {
  const GapScreen screen = Screen();
  const VectorXd x = screen.BaselineGiven(JointRows(2), 3);
  EXPECT_EQ(x.tail(2).norm(), 0);
  for (MatrixXd& A : baseline_) A.rightCols(2).setZero();
  EXPECT_LT((x - Screen().BaselineGiven(JointRows(2))).norm(), kTight);
}

// The trace of the matrix that makes a joint's fitted rows of its rows.
TEST_F(GapScreenTest, FittedRowsAreTheTraceOfTheHatMatrix) {
  const GapScreen screen = Screen();
  MatrixXd A(70, kBaseline);
  A << baseline_[0], baseline_[1];
  const MatrixXd hat =
      A *
      (A.transpose() * A + MatrixXd::Identity(kBaseline, kBaseline)).inverse() *
      A.transpose();
  EXPECT_NEAR(screen.FittedRows()[0], hat.topLeftCorner(40, 40).trace(),
              kTight);
  EXPECT_NEAR(screen.FittedRows()[1], hat.bottomRightCorner(30, 30).trace(),
              kTight);
}

}  // namespace armcal::screen_test
