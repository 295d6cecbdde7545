#include "calib/diagnose/select/reference_folds.h"

#include <gmock/gmock.h>

namespace armcal::reference_folds_test {

using testing::Each;
using testing::Field;

// A segment of so many seconds from t0 on.
GapSegment Segment(int log, double t0, double seconds) {
  GapSegment segment;
  segment.log = log;
  segment.motion.t0 = t0;
  segment.motion.dt = .01;
  segment.motion.q = Eigen::MatrixXd::Zero(std::lround(100 * seconds) + 1, 1);
  return segment;
}

TEST(ReferenceFolds, AreThirdsOfASingleLog) {
  const std::vector<GapSegment> segments = {Segment(0, 1, 6),
                                            Segment(0, 20, 3)};
  const auto folds = FoldsOf(segments);
  ASSERT_EQ(folds.size(), 3u);
  EXPECT_THAT(folds, Each(Field(&ReferenceFold::log, -1)));
  EXPECT_NEAR(folds[1].WindowOf(segments[0]).begin, 3, 1e-9);
  EXPECT_NEAR(folds[1].WindowOf(segments[0]).end, 5, 1e-9);
  EXPECT_NEAR(folds[2].WindowOf(segments[1]).end, 23, 1e-9);
}

TEST(ReferenceFolds, AreWholeLogsOfSeveral) {
  const std::vector<GapSegment> segments = {Segment(0, 0, 6), Segment(0, 9, 3),
                                            Segment(2, 0, 4)};
  const auto folds = FoldsOf(segments);
  ASSERT_EQ(folds.size(), 2u);
  EXPECT_EQ(folds[0].log, 0);
  EXPECT_EQ(folds[1].log, 2);
  EXPECT_NEAR(folds[1].WindowOf(segments[2]).begin, 0, 1e-9);
  EXPECT_NEAR(folds[1].WindowOf(segments[2]).end, 4, 1e-9);
}

}  // namespace armcal::reference_folds_test
