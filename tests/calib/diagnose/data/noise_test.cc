#include "calib/diagnose/data/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::noise_test {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = .004, kBandwidth = 5;
constexpr double kPeriod = 6;  // s
constexpr double kNoise = .8;  // N m, white, on the segment's own grid

// Of white noise behind the low pass: the integral of (1 + (f/fc)^8)^-2 is
// fc pi/8 / sin(pi/8) 7/8, of half the sample rate.
double Stddev() {
  const double hz = kBandwidth * M_PI / 8 / std::sin(M_PI / 8) * 7 / 8;
  return kNoise * std::sqrt(hz * 2 * kStep);
}

// 0 while the arm rests, 1 when it moves, with smooth ends of a second.
ArrayXd Moves(const ArrayXd& t, double begin, double end) {
  const ArrayXd up = (t - begin).max(0).min(1), down = (end - t).max(0).min(1);
  const ArrayXd u = up.min(down);
  return u.pow(3) * (10 - 15 * u + 6 * u.square());
}

// Two joints that start after 3 s, move for 36 s and rest again. What the model
// lacks is a function of the motion, ten times the noise.
class GapNoiseTest : public testing::Test {
 protected:
  GapNoiseTest()
      : t_(ArrayXd::LinSpaced(10500, 0, 10499 * kStep)),
        moves_(Moves(t_, 3, 39)) {}

  // frequency: of joint 1 beside joint 2, whose motion repeats.
  void Move(double frequency) {
    GapSegment segment;
    segment.motion.dt = kStep;
    segment.motion.q.resize(t_.size(), 2);
    segment.motion.q.col(0) =
        moves_ * (2 * M_PI * frequency / kPeriod * t_).sin();
    segment.motion.q.col(1) = moves_ * (4 * M_PI / kPeriod * t_).cos();
    segment.motion.qd = Difference(segment.motion.q);
    segment.tau.setZero(t_.size(), 2);
    segment.still.setConstant(t_.size(), 2, false);
    noise_.setZero(t_.size(), 2);
    AddNoise(&random_, VectorXd::Constant(2, kNoise), &noise_);
    MatrixXd lack(t_.size(), 2);
    lack << 10 * kNoise * (5 * segment.motion.q.col(0).array()).sin().matrix(),
        10 * kNoise * (4 * segment.motion.q.col(1).array()).cos().matrix();
    segments_ = {segment};
    residual_ = {lack + noise_};
  }
  static MatrixXd Difference(const MatrixXd& q) {
    MatrixXd qd = MatrixXd::Zero(q.rows(), q.cols());
    qd.bottomRows(q.rows() - 1) =
        (q.bottomRows(q.rows() - 1) - q.topRows(q.rows() - 1)) / kStep;
    return qd;
  }
  // A joint that stands is held by its friction, at an offset.
  void Rest(int joint, double begin, double end) {
    for (int k = 0; k < t_.size(); ++k) {
      if (t_[k] < begin || t_[k] >= end) continue;
      segments_[0].still(k, joint) = true;
      residual_[0](k, joint) = 4 * kNoise + noise_(k, joint);
    }
  }
  GapNoise Estimate() const {
    const GapRows rows(segments_, kBandwidth);
    return EstimateGapNoise(rows, residual_,
                            MatrixXd::Constant(rows.num_thin(), 2, 7));
  }
  void ExpectNoise(const GapNoise& noise, int joint) const {
    ASSERT_EQ(noise.joints.size(), 2u);
    EXPECT_NEAR(noise.joints[joint].stddev() / Stddev(), 1, .15) << joint;
  }

  std::mt19937_64 random_{3};
  ArrayXd t_, moves_;
  std::vector<GapSegment> segments_;
  std::vector<MatrixXd> residual_;
  MatrixXd noise_;
};

TEST_F(GapNoiseTest, IsWhatDiffersFromRepeatToRepeat) {
  Move(3);
  for (int k = 0; k < t_.size(); ++k) {
    if (moves_[k] == 0) segments_[0].still.row(k) = true;
  }
  const GapNoise noise = Estimate();
  EXPECT_EQ(noise.source, NoiseFloor::kRepeats);
  ExpectNoise(noise, 0);
  ExpectNoise(noise, 1);
}

// Without repeats, what a model lacks is not noise either where joints stand.
TEST_F(GapNoiseTest, IsTheScatterOfJointsThatStand) {
  Move(M_PI);  // never the same again
  Rest(0, 0, 15);
  Rest(1, 20, 42);
  const GapNoise noise = Estimate();
  EXPECT_EQ(noise.source, NoiseFloor::kStandstill);
  ExpectNoise(noise, 0);
  ExpectNoise(noise, 1);
}

TEST_F(GapNoiseTest, IsAssumedWhereNothingTells) {
  Move(M_PI);
  Rest(0, 0, 15);
  const GapNoise noise = Estimate();
  EXPECT_EQ(noise.source, NoiseFloor::kAssumed);
  ExpectNoise(noise, 0);
  EXPECT_GT(noise.joints[1].stddev(), 5 * Stddev());  // 7 N m was assumed
}

// Three seconds of rest hold too few samples to be judged by.
TEST_F(GapNoiseTest, AShortRestTellsNothing) {
  Move(M_PI);
  Rest(0, 0, 3);
  Rest(1, 0, 3);
  EXPECT_EQ(Estimate().source, NoiseFloor::kAssumed);
}

TEST_F(GapNoiseTest, OfAReferenceIsAllThatIsLeft) {
  Move(3);
  const GapRows rows(segments_, kBandwidth);
  MatrixXd left = MatrixXd::Zero(rows.num_thin(), 2);
  AddNoise(&random_, Eigen::Vector2d(.3, 2), &left);
  const GapNoise noise = ResidualNoise(rows, left);
  EXPECT_EQ(noise.source, NoiseFloor::kReference);
  EXPECT_NEAR(noise.joints[0].stddev(), .3, .045);
  EXPECT_NEAR(noise.joints[1].stddev(), 2, .3);
}

TEST(NoiseFloor, HasTheNamesOfTheReport) {
  EXPECT_STREQ(NoiseFloorName(NoiseFloor::kRepeats), "repeats");
  EXPECT_STREQ(NoiseFloorName(NoiseFloor::kStandstill), "standstill");
  EXPECT_STREQ(NoiseFloorName(NoiseFloor::kReference), "reference");
  EXPECT_STREQ(NoiseFloorName(NoiseFloor::kAssumed), "assumed");
}

}  // namespace armcal::noise_test
