#include "calib/diagnose/select/motion_range.h"

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
  const GapRows& rows() {
    if (!rows_) rows_.emplace(segments_, kBandwidth);
    return *rows_;
  }
  // Share of the other's time that is within this one's motion.
  double ShareOf(Swing other) {
    const auto within = MotionRange(rows()).Contains(other.rows());
    return within.cast<double>().mean();
  }

 private:
  std::vector<GapSegment> segments_;
  std::optional<GapRows> rows_;
};

TEST(MotionRange, HoldsItsOwnMotionButForTheFastestSamples) {
  const double own = Swing({1, 1}).ShareOf(Swing({1, 1}));
  EXPECT_GT(own, .85);
  EXPECT_LT(own, 1);
  EXPECT_EQ(Swing({1, 1}).ShareOf(Swing({.9, .9})), 1);
}

// |2 cos 2t| is below 1 in a third of the time, and |4 sin 2t| in a sixth, but
// never both at once.
TEST(MotionRange, HasNothingOfMotionThatIsFasterOrHarder) {
  EXPECT_EQ(Swing({1, 1}).ShareOf(Swing({1, 2})), 0);
  EXPECT_EQ(Swing({1, 1}).ShareOf(Swing({2, 1})), 0);
}

// |1.4 cos| < 1 leaves the speed in half of the time, where the acceleration
// 1.96 |sin| is beyond 1 already.
TEST(MotionRange, AsksForSpeedAndAcceleration) {
  EXPECT_LT(Swing({1}).ShareOf(Swing({1.4})), .05);
  EXPECT_EQ(Swing({2}).ShareOf(Swing({1.4})), 1);
}

TEST(MotionRange, DoesNotFollowAJumpOfAnEncoder) {
  Swing jumps({1, 1});
  jumps.WithAJump(0);
  EXPECT_EQ(jumps.ShareOf(Swing({2, 1})), 0);
}

}  // namespace armcal::motion_range_test
