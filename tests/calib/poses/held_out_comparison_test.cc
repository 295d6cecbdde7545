// Models compared by poses that they have not seen.

#include "calib/poses/held_out_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace armcal::held_out_comparison_test {

using Eigen::ArrayXd;
using Eigen::RowVectorXd;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

PredictedSquares Model(std::initializer_list<double> squares,
                       const std::vector<int>& outliers = {}) {
  PredictedSquares model;
  model.squares = Eigen::Map<const ArrayXd>(squares.begin(), squares.size());
  model.outliers = outliers;
  return model;
}

// By hand: rows 0 and 1 are readings of pose 0, of which both models give up
// row 1; row 2 is given up by one of them; pose 2 is not predicted by the
// other.
TEST(HeldOutComparison, IsOfPosesThatAllPredictAndNotAllGiveUp) {
  const Eigen::MatrixXd squares =
      SquaresByPose({Model({1, 900, 4, 2, 6, 5}, {1, 2}),
                     Model({2, 800, 8, 1, 3, kNone}, {1})},
                    {0, 0, 1, 3, 3, 2});
  ASSERT_EQ(squares.cols(), 3);
  EXPECT_EQ(squares.row(0), RowVectorXd(Eigen::RowVector3d(1, 4, 4)));
  EXPECT_EQ(squares.row(1), RowVectorXd(Eigen::RowVector3d(2, 8, 2)));
}

// Differences 1, 2, 3, 6: mean 3, of which the variance is 14/3 / 4.
TEST(HeldOutComparison, HasTheStandardErrorOfAMean) {
  const HeldOutExcess excess =
      ExcessOf(Eigen::RowVector4d(3, 4, 5, 8), Eigen::RowVector4d(2, 2, 2, 2));
  EXPECT_DOUBLE_EQ(excess.mean, 3);
  EXPECT_DOUBLE_EQ(excess.stderr_of_mean, std::sqrt(14. / 3 / 4));
  EXPECT_TRUE(excess.is_clear());
  EXPECT_FALSE(HeldOutExcess().is_clear());
}

// Thirty readings of each of four poses are four poses: what is no more than
// chance stays that.
TEST(HeldOutComparison, CountsAPoseOnce) {
  const RowVectorXd one = Eigen::RowVector4d(4, 0, 3, 0);
  const auto compare = [&](int readings) {
    PredictedSquares a, b;
    a.squares.resize(4 * readings);
    b.squares = ArrayXd::Ones(4 * readings);
    std::vector<int> pose_of_row;
    for (int k = 0; k < 4 * readings; ++k) {
      a.squares[k] = one[k / readings];
      pose_of_row.push_back(k / readings);
    }
    const Eigen::MatrixXd squares = SquaresByPose({a, b}, pose_of_row);
    return ExcessOf(squares.row(0), squares.row(1));
  };
  EXPECT_GT(compare(1).mean, 0);
  EXPECT_FALSE(compare(1).is_clear());
  EXPECT_DOUBLE_EQ(compare(30).stderr_of_mean, compare(1).stderr_of_mean);
}

}  // namespace armcal::held_out_comparison_test
