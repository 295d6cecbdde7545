#include "calib/diagnose/contacts/excess.h"

#include <gtest/gtest.h>

namespace armcal::excess_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = .01, kCoulomb = 10, kNoise = .5;

// One joint that rests for 10 s and then moves at 1 rad/s for 10 s.
class ExcessOfAJoint : public testing::Test {
 protected:
  ExcessOfAJoint() {
    GapSegment segment;
    segment.motion.dt = kStep;
    segment.motion.q.setZero(2000, 1);
    segment.motion.qd.setZero(2000, 1);
    segment.motion.qd.bottomRows(1000).setOnes();
    segment.tau.setZero(2000, 1);
    segment.still = segment.motion.qd.array() == 0;
    segments_ = {segment};
    rows_.emplace(segments_, 10);
    std::vector<Autoregression> noise(1);
    noise[0].sigma = kNoise;
    rows_->SetNoise(noise, MatrixXd::Zero(rows_->num_thin(), 1));
  }
  // At `time`, of a residual that is `rest` before 10 s and `moving` after.
  double Deviations(double rest, double moving, double time) const {
    return DeviationsOf([&](double t) { return t < 10 ? rest : moving; }, time);
  }
  // At `time`, of a residual that is `push` for .6 s around it.
  double DeviationsOfAPush(double push, double time) const {
    return DeviationsOf(
        [&](double t) { return std::abs(t - time) < .3 ? push : 0; }, time);
  }
  template <typename Residual>
  double DeviationsOf(Residual of_time, double time) const {
    Robot robot;
    robot.links.resize(1);
    robot.links[0].joint.coulomb = kCoulomb;
    const GapBaseline baseline(robot, BaselineOptions(),
                               VectorXd::Constant(1, 10));
    MatrixXd residual(rows_->num_thin(), 1);
    int at = 0;
    for (int k = 0; k < residual.rows(); ++k) {
      residual(k, 0) = of_time(rows_->thin_time(0, k));
      if (rows_->thin_time(0, k) < time) at = k;
    }
    return ExcessOverFriction(baseline, VectorXd::Zero(baseline.size()), *rows_,
                              residual)
        .deviations(at, 0);
  }

  std::vector<GapSegment> segments_;
  std::optional<GapRows> rows_;
};

// What friction holds at rest is unknown; in motion it is in the model, and a
// push along the motion has to overcome all of it to be seen.
TEST_F(ExcessOfAJoint, IsWhatIsBeyondItsFriction) {
  EXPECT_NEAR(Deviations(9, 0, 5), (9 - kCoulomb) / kNoise, 1e-9);
  EXPECT_NEAR(Deviations(-14, 0, 5), (14 - kCoulomb) / kNoise, 1e-9);
  EXPECT_NEAR(Deviations(0, 0, 15), 0, 1e-3);
  EXPECT_NEAR(Deviations(0, -25, 15), (25 - 2 * kCoulomb) / kNoise, 1e-3);
}

// All of the motion against more friction than the model's is friction.
TEST_F(ExcessOfAJoint, AllowsForTheFrictionOfTheDay) {
  EXPECT_NEAR(Deviations(0, 3, 15), 0, 1e-3);
  EXPECT_NEAR(Deviations(14, 3, 5), (14 - kCoulomb - 3) / kNoise, 1e-3);
}

// What drives it out of its rest may be against static friction, .78 / .42 of
// the Coulomb one; a push that moves it drives the other way.
TEST_F(ExcessOfAJoint, BreaksAwayFromStaticFriction) {
  EXPECT_NEAR(DeviationsOfAPush(8, 15), 8 / kNoise, 1e-3);
  EXPECT_NEAR(DeviationsOfAPush(8, 10.3),
              (kCoulomb + 8 - kCoulomb * .78 / .42) / kNoise, .02);
  EXPECT_NEAR(DeviationsOfAPush(-25, 10.3), (25 - 2 * kCoulomb) / kNoise, .02);
}

TEST_F(ExcessOfAJoint, HasMaximaOfBlocks) {
  EXPECT_EQ(BlockTime(*rows_), 2);
  // 8 s without .4 s at both ends, in eight blocks.
  GapSegment first = segments_[0];
  first.motion.q.conservativeResize(800, 1);
  first.motion.qd.conservativeResize(800, 1);
  first.tau.conservativeResize(800, 1);
  first.still.conservativeResize(800, 1);
  const std::vector<GapSegment> short_log = {first};
  EXPECT_NEAR(BlockTime(GapRows(short_log, 10)), .9, .01);
  const int size = rows_->num_thin();
  const std::vector<double> maxima =
      BlockMaxima(*rows_, 2, VectorXd::LinSpaced(size, 0, size - 1));
  ASSERT_EQ(maxima.size(), 10u);
  EXPECT_EQ(maxima.back(), size - 1);
  for (size_t k = 0; k + 1 < maxima.size(); ++k) {
    const int last = static_cast<int>(maxima[k]);
    EXPECT_LT(rows_->thin_time(0, last), 2. * (k + 1));
    EXPECT_GE(rows_->thin_time(0, last + 1), 2. * (k + 1));
  }
}

}  // namespace armcal::excess_test
