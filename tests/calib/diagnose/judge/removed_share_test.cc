#include "calib/diagnose/judge/removed_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::removed_share_test {

using Eigen::MatrixXd;

constexpr double kStill = std::numeric_limits<double>::quiet_NaN();

// Two joints, of which the second stands still half of the time.
TEST(RemovedShare, FiguresAreThoseCountedByHand) {
  HeldOutSquares squares;
  squares.nominal.resize(4, 2);
  squares.nominal << 16, 4, 16, kStill, 16, 4, 16, kStill;
  squares.refit.resize(4, 2);
  squares.refit << 9, 1, 7, kStill, 9, 1, 7, kStill;
  squares.after.resize(4, 2);
  squares.after << 1, 2, 3, kStill, 1, 2, 3, kStill;
  const GapFigures figures = RemovedShareFigures(squares, 0, 1);
  EXPECT_NEAR(figures.nominal, 72 / 6., 1e-9);
  EXPECT_NEAR(figures.refit, 34 / 6., 1e-9);
  EXPECT_NEAR(figures.after, 2, 1e-9);
  EXPECT_EQ(figures.floor, 1);
  // (34 / 6 - 2) / (34 / 6 - 1), (12 - 2) / (12 - 1) and
  // (12 - 34 / 6) / (12 - 1).
  EXPECT_NEAR(figures.removed_percent, 100 * 22 / 28., 1e-9);
  EXPECT_NEAR(figures.removed_from_nominal_percent, 1000 / 11., 1e-9);
  EXPECT_NEAR(figures.refit_removes_percent, 3800 / 66., 1e-9);
  ASSERT_EQ(figures.joints.rows(), 2);
  EXPECT_NEAR(figures.joints(0, 0), 4, 1e-9);
  EXPECT_NEAR(figures.joints(0, 1), std::sqrt(8), 1e-9);
  EXPECT_NEAR(figures.joints(0, 2), std::sqrt(2), 1e-9);
  EXPECT_NEAR(figures.joints(1, 0), 2, 1e-9);
  EXPECT_NEAR(figures.joints(1, 1), 1, 1e-9);
  EXPECT_NEAR(figures.joints(1, 2), std::sqrt(2), 1e-9);
}

// All but the floor is exact: 100 (9 - 2) / (9 - floor).
TEST(RemovedShare, AnUncertainFloorIsInTheInterval) {
  HeldOutSquares squares;
  squares.nominal = squares.refit = MatrixXd::Constant(400, 1, 9);
  squares.after = MatrixXd::Constant(400, 1, 2);
  const GapFigures exact = RemovedShareFigures(squares, 0, 1);
  EXPECT_NEAR(exact.ci95[0], 87.5, 1e-9);
  EXPECT_NEAR(exact.ci95[1], 87.5, 1e-9);
  const GapFigures uncertain = RemovedShareFigures(squares, .2, 1);
  EXPECT_NEAR(uncertain.ci95[0], 700 / 8.4, .4);
  EXPECT_NEAR(uncertain.ci95[1], 700 / 7.6, .4);
}

TEST(RemovedShare, MeanSquareIsOfWhatMoves) {
  MatrixXd squares(2, 2);
  squares << 1, kStill, 2, 6;
  EXPECT_NEAR(MeanSquare(squares), 3, 1e-12);
  EXPECT_EQ(MeanSquare(MatrixXd::Constant(2, 2, kStill)), 1);
}

TEST(RemovedShare, WhereNothingCanBeRemovedNoShareIs) {
  HeldOutSquares squares;
  squares.nominal = MatrixXd::Constant(50, 1, 3);
  squares.refit = squares.after = MatrixXd::Constant(50, 1, .9);
  const GapFigures figures = RemovedShareFigures(squares, 0, 1);
  EXPECT_TRUE(std::isnan(figures.removed_percent));
  EXPECT_NEAR(figures.floor, .9, 1e-9);
  EXPECT_NEAR(figures.removed_from_nominal_percent, 100, 1e-9);
  squares.nominal = squares.refit;
  EXPECT_TRUE(
      std::isnan(RemovedShareFigures(squares, 0, 1).refit_removes_percent));
}

// The noise is at most what is left: .6 of what was taken for it.
TEST(RemovedShare, AFloorToldTooHighRemovesAllNotMore) {
  HeldOutSquares squares;
  squares.nominal = squares.refit = MatrixXd::Constant(400, 1, 9);
  squares.after = MatrixXd::Constant(400, 1, .6);
  const GapFigures figures = RemovedShareFigures(squares, .2, 1);
  EXPECT_NEAR(figures.removed_percent, 100, 1e-9);
  EXPECT_NEAR(figures.ci95[1], 100, 1e-9);
  // 8.4 of 8.4 + 2 x .2 x .6 and somewhat more.
  EXPECT_LT(figures.ci95[0], 97.5);
  EXPECT_GT(figures.ci95[0], 96);
}

TEST(RemovedShare, AJointThatNeverMovesHasNoFigure) {
  HeldOutSquares squares;
  squares.nominal.setConstant(50, 2, 4);
  squares.nominal.col(1).setConstant(kStill);
  squares.refit = squares.after = squares.nominal;
  const GapFigures figures = RemovedShareFigures(squares, 0, 1);
  EXPECT_EQ(figures.joints(0, 0), 2);
  EXPECT_TRUE(std::isnan(figures.joints(1, 0)));
  EXPECT_EQ(figures.nominal, 4);
}

// What is the same everywhere is known exactly.
TEST(RemovedShare, SteadyGapsHaveNoInterval) {
  HeldOutSquares squares;
  squares.nominal = MatrixXd::Constant(100, 2, 10);
  squares.refit = MatrixXd::Constant(100, 2, 5);
  squares.after = MatrixXd::Constant(100, 2, 2);
  const GapFigures figures = RemovedShareFigures(squares, 0, 1);
  EXPECT_NEAR(figures.ci95[0], 75, 1e-9);
  EXPECT_NEAR(figures.ci95[1], 75, 1e-9);
  EXPECT_NEAR(figures.nominal_ci95[0], 800 / 9., 1e-9);
  EXPECT_NEAR(figures.nominal_ci95[1], 800 / 9., 1e-9);
}

// Mean squares 5 and 2 of independent samples: 75 % is what is removed.
TEST(RemovedShare, IntervalsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kRuns = 100, kSamples = 400;
  std::mt19937_64 random(4);
  int covered = 0;
  for (int run = 0; run < kRuns; ++run) {
    HeldOutSquares squares;
    for (MatrixXd* x : {&squares.nominal, &squares.refit, &squares.after}) {
      x->resize(kSamples, 1);
      for (double& value : x->reshaped()) value = std::pow(Normal(&random), 2);
    }
    squares.nominal *= 10;
    squares.refit *= 5;
    squares.after *= 2;
    const GapFigures figures = RemovedShareFigures(squares, 0, run);
    covered += figures.ci95[0] < 75 && 75 < figures.ci95[1];
  }
  // 95 of 100 within three binomial deviations.
  EXPECT_GE(covered, 88);
  EXPECT_LE(covered, 99);
}

}  // namespace armcal::removed_share_test
