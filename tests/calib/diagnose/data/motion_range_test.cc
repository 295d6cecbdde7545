#include "calib/diagnose/data/motion_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace armcal::motion_range_test {

constexpr double kStep = .004, kBandwidth = 10;
constexpr int kSize = 5000;  // samples: 20 s

// A log of joints that swing as sin(rate t), one joint per rate.
class Swing {
 public:
  explicit Swing(std::vector<double> rates) {
    const int n = static_cast<int>(rates.size());
    GapSegment segment;
    Motion& motion = segment.motion;
    motion.dt = kStep;
    motion.q.resize(kSize, n);
    motion.qd.resize(kSize, n);
    motion.qdd.resize(kSize, n);
    for (int k = 0; k < kSize; ++k) {
      for (int j = 0; j < n; ++j) {
        const double r = rates[j], at = r * motion.time(k);
        motion.q(k, j) = std::sin(at);
        motion.qd(k, j) = r * std::cos(at);
        motion.qdd(k, j) = -r * r * std::sin(at);
      }
    }
    segment.tau.setZero(kSize, n);
    segment.still = motion.qd.array() == 0;
    segments_ = {segment};
  }
  // An encoder that is wrong in one sample, by central differences.
  Swing& WithAJump(int joint) {
    constexpr double kJump = .3;  // rad
    const int k = kSize / 2;
    Motion& motion = segments_[0].motion;
    for (const int side : {-1, 1}) {
      motion.qd(k + side, joint) -= side * kJump / (2 * kStep);
      motion.qdd(k + side, joint) += kJump / (kStep * kStep);
    }
    motion.qdd(k, joint) -= 2 * kJump / (kStep * kStep);
    return *this;
  }
  // One that turns one way only.
  Swing& Forward(int joint) {
    segments_[0].motion.qd.col(joint) =
        segments_[0].motion.qd.col(joint).cwiseAbs().eval();
    return *this;
  }
  const GapRows& rows() {
    if (!rows_) rows_.emplace(segments_, kBandwidth);
    return *rows_;
  }
  Eigen::ArrayXd GrowthOf(Swing other) {
    return MotionRange(rows()).Growth(other.rows());
  }
  Eigen::ArrayXXd OwnGrowthOf(Swing other) {
    return MotionRange(rows()).OwnGrowth(other.rows());
  }

 private:
  std::vector<GapSegment> segments_;
  std::optional<GapRows> rows_;
};

TEST(MotionRange, IsThatOfAllButTheFastestSamples) {
  const Eigen::ArrayXd own = Swing({1, 1}).GrowthOf(Swing({1, 1}));
  EXPECT_GT((own == 1).cast<double>().mean(), .85);
  EXPECT_GT(own.maxCoeff(), 1);
  EXPECT_LT(own.maxCoeff(), 1.02);
  EXPECT_EQ(Swing({1, 1}).GrowthOf(Swing({.9, .9})).maxCoeff(), 1);
}

// |2 cos 2t|^2 and |4 sin 2t| are 4 at most, where the other is 0; the larger
// of both is least where cos^2 = sin, which is the golden section.
TEST(MotionRange, GrowsWithTheSquareOfSpeedAndWithAcceleration) {
  const double least = 4 * (std::sqrt(5.) - 1) / 2;
  for (const Swing& faster : {Swing({1, 2}), Swing({2, 1})}) {
    const Eigen::ArrayXd growth = Swing({1, 1}).GrowthOf(faster);
    EXPECT_NEAR(growth.minCoeff(), least, .05 * least);
    EXPECT_NEAR(growth.maxCoeff(), 4, .05 * 4);
  }
}

TEST(MotionRange, DoesNotFollowAJumpOfAnEncoder) {
  Swing jumps({1, 1});
  jumps.WithAJump(0);
  EXPECT_GT(jumps.GrowthOf(Swing({2, 1})).minCoeff(), 2);
}

TEST(MotionRange, OfAJointThatRestedIsNone) {
  const Eigen::ArrayXd growth = Swing({1, 0}).GrowthOf(Swing({1, 1}));
  EXPECT_TRUE(std::isinf(growth.minCoeff()));
}

// The second joint swings twice as fast as it did: its speeds are up to twice
// those of 95 % of the time before, squared, its accelerations four times. The
// first is as it was, and the third has moved in neither.
TEST(MotionRange, AJointsOwnMotionCountsAlone) {
  const Eigen::ArrayXXd growth = Swing({2, 2, 0}).OwnGrowthOf(Swing({2, 4, 0}));
  const double usual = std::sin(.95 * M_PI / 2);  // quantile of a sine's size
  EXPECT_LT(growth.col(0).maxCoeff(), 1.01 / (usual * usual));
  EXPECT_NEAR(growth.col(1).maxCoeff(), 4 / (usual * usual), .05);
  // Of the square of the speed and the acceleration, as above.
  const double least = 4 * (std::sqrt(5.) - 1) / 2;
  EXPECT_NEAR(growth.col(1).minCoeff(), least, .05 * least);
  EXPECT_EQ(growth.col(2).maxCoeff(), 1);
}

// Of a joint that went forward only nothing is known of the way back; of one
// that went both ways, and of one that rested, there is nothing to ask.
TEST(MotionRange, KnowsTheWaysThatAJointMoved) {
  Swing log({1, 1, 1}), reference({1, 1, 0});
  reference.Forward(0);
  const auto knows = MotionRange(reference.rows()).Knows(log.rows());
  const Eigen::MatrixXd velocities =
      log.rows().Pick(0, log.rows().segments()[0].motion.qd);
  for (int k = 0; k < knows.rows(); ++k) {
    EXPECT_EQ(knows(k, 0), velocities(k, 0) >= 0) << k;
  }
  EXPECT_TRUE(knows.col(1).all());
  EXPECT_TRUE(knows.col(2).all());
}

}  // namespace armcal::motion_range_test
