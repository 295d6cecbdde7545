#include "calib/poses/repeated_poses.h"

#include <gmock/gmock.h>

namespace armcal::repeated_poses_test {

using testing::ElementsAre;

TEST(RepeatedPoses, AreRowsWithTheSameJoints) {
  Eigen::MatrixXd q(6, 2);
  q << 0, 1,          // pose 0
      0, 1 + 5e-5,    // again
      .5, 1,          // pose 1
      0, 1 + 1.5e-4,  // too far from the first row, near the second
      .5 - 5e-5, 1,   // pose 1, later
      0, 1;           // pose 0, later
  EXPECT_THAT(RepeatedPoses(q), ElementsAre(0, 0, 1, 2, 1, 0));
  EXPECT_EQ(CountPoses(RepeatedPoses(q)), 3);
  EXPECT_TRUE(RepeatedPoses(Eigen::MatrixXd(0, 2)).empty());
}

TEST(RepeatedPoses, AreLeftOutTogether) {
  const std::vector<int> poses = {0, 0, 1, 1, 2, 3, 0};
  EXPECT_THAT(InterleavedFolds(poses, 2), ElementsAre(0, 0, 1, 1, 0, 1, 0));
  EXPECT_THAT(ContiguousFolds(poses, 2), ElementsAre(0, 0, 0, 0, 1, 1, 0));
}

TEST(RepeatedPoses, HaveOneMean) {
  Eigen::MatrixXd by_row(1, 3);
  by_row << 1, 3, 7;
  const Eigen::MatrixXd means = MeansByPose(by_row, {0, 0, 1});
  EXPECT_EQ(means(0, 0), 2);
  EXPECT_EQ(means(0, 1), 7);
}

}  // namespace armcal::repeated_poses_test
