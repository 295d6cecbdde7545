#include "calib/diagnose/judge/forward.h"

#include <gmock/gmock.h>

#include <cmath>

#include "model/signals/low_pass.h"
#include "tests/fixtures/corrected_arm.h"

namespace armcal::forward_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kEncoder = 1e-5;  // rad
constexpr double kTorque = .1;     // N m
constexpr double kBandwidth = 15;  // Hz
constexpr double kRate = 250;      // Hz

// A log of a true arm that is written by hand, and the robots that a perfect
// diagnosis would have found.
class ForwardGapTest : public testing::Test {
 protected:
  ForwardGapTest() : baseline_(arm_.Baseline()) {
    log_.path = "log";
    log_.log = Record(kRate);
  }
  Log Record(double rate_hz) const {
    SensorOptions sensors;
    sensors.encoder_noise = VectorXd::Constant(3, kEncoder);
    sensors.torque_noise = VectorXd::Constant(3, kTorque);
    sensors.log_rate_hz = rate_hz;
    return arm_.Record(8, sensors);
  }

  CorrectedRobot Make(const VectorXd& x, bool with_effect) const {
    std::vector<GapCandidate> effects;
    if (with_effect) effects.push_back(arm_.Found());
    return MakeCorrectedRobot(baseline_, x, effects, arm_.scale);
  }
  VectorXd Truth() const { return arm_.TrueValues(baseline_, 0); }
  // Without the friction's true way through zero velocity.
  VectorXd WithReferenceWidth() const {
    VectorXd x = Truth();
    for (int c = 0; c < x.size(); ++c) {
      const auto kind = baseline_.columns()[c].kind;
      if (kind == BaselineColumn::Kind::kZeroVelocity) x[c] = 0;
    }
    return x;
  }
  ForwardRobots Robots() const {
    return {Make(VectorXd::Zero(baseline_.size()), false), Make(Truth(), false),
            Make(Truth(), true)};
  }
  ForwardGap InLoop(const ForwardRobots& robots) const {
    return ForwardGapInLoop(robots, arm_.file, arm_.Controller(), {log_}, 1);
  }
  // At the controller's rate: a slower log would miss most of what encoder
  // noise makes the controller do.
  GapSegment Segment() const {
    const Log log = Record(1000);
    GapSegment segment;
    segment.motion.dt = 1e-3;
    segment.motion.q = ZeroPhaseLowPass(log.q, 1000, kBandwidth);
    segment.motion.qd = Differentiate(segment.motion.q, 1e-3);
    segment.motion.qdd = Differentiate(segment.motion.qd, 1e-3);
    segment.tau = log.tau;
    segment.still.setConstant(segment.size(), 3, false);
    return segment;
  }
  MeasurementNoise Noise() const {
    MeasurementNoise noise;
    noise.position = VectorXd::Constant(3, kEncoder);
    noise.rate_hz = 1000;
    noise.bandwidth_hz = kBandwidth;
    noise.torque.resize(3);
    for (Autoregression& one : noise.torque) one.sigma = kTorque;
    noise.torque_step = 1e-3;
    return noise;
  }

  CorrectedArm arm_;
  GapBaseline baseline_;
  CommandedLog log_;
};

void ExpectInterval(const GapFigures& figures) {
  EXPECT_LT(figures.ci95[0], figures.removed_percent);
  EXPECT_GE(figures.ci95[1], figures.removed_percent);
  EXPECT_LT(figures.nominal_ci95[0], figures.removed_from_nominal_percent);
  EXPECT_GE(figures.nominal_ci95[1], figures.removed_from_nominal_percent);
}

// The truth leaves the encoders' noise, and what the command loses between the
// log's rows; every lesser robot more.
TEST_F(ForwardGapTest, InClosedLoopTheTruthLeavesTheFloor) {
  const ForwardGap gap = InLoop(Robots());
  EXPECT_TRUE(gap.closed_loop);
  EXPECT_EQ(gap.runs, 1);
  EXPECT_THAT(gap.diverged, testing::Each(0));
  const GapFigures& figures = gap.figures;
  EXPECT_NEAR(figures.after, 1, .15);
  EXPECT_GT(figures.refit, 3);
  EXPECT_GT(figures.nominal, 3);
  EXPECT_NEAR(figures.removed_percent, 100, 5);
  EXPECT_NEAR(figures.removed_from_nominal_percent, 100, 5);
  ExpectInterval(figures);
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(gap.floor[j] / kEncoder, 1, .1);
    EXPECT_NEAR(figures.joints(j, 2) / kEncoder, 1, .15);
  }
  // The effect is on the second joint.
  EXPECT_GT(figures.joints(1, 1), 3 * figures.joints(1, 2));
}

// Friction that changes sign as the regression's reference does, and not as the
// log showed, leaves more than the noise.
TEST_F(ForwardGapTest, InClosedLoopTheWayThroughZeroVelocityShows) {
  ForwardRobots robots = Robots();
  const double with = InLoop(robots).figures.after;
  robots.after = Make(WithReferenceWidth(), true);
  EXPECT_GT(InLoop(robots).figures.after - 1, 5 * std::abs(with - 1));
}

TEST_F(ForwardGapTest, InWindowsTheTruthLeavesWhatNoiseDoes) {
  const ForwardGap gap = ForwardGapInWindows(Robots(), {Segment()}, Noise(), 1);
  EXPECT_FALSE(gap.closed_loop);
  EXPECT_EQ(gap.runs, 14);
  EXPECT_THAT(gap.diverged, testing::Each(0));
  const GapFigures& figures = gap.figures;
  EXPECT_GT(figures.after, .5);
  EXPECT_LT(figures.after, 2);
  EXPECT_GT(figures.refit, 10);
  EXPECT_GT(figures.nominal, 10);
  EXPECT_GT(figures.removed_percent, 90);
  ExpectInterval(figures);
}

// Where only a part counts, what happened outside is nothing to it.
TEST_F(ForwardGapTest, PartsThatDoNotCountAreNotSeen) {
  const ForwardRobots robots = Robots();
  const auto late = [](int, double t) { return t > 5; };
  Log& log = log_.log;
  log.q.middleRows(500, 500).array() += .1;  // 2 to 4 s
  const ForwardGap all = InLoop(robots);
  const ForwardGap part =
      ForwardGapInLoop(robots, arm_.file, arm_.Controller(), {log_}, 1, late);
  EXPECT_GT(all.figures.after, 1e5);
  EXPECT_NEAR(part.figures.after, 1, .2);
  EXPECT_EQ(ForwardGapInWindows(robots, {Segment()}, Noise(), 1, late).runs, 5);
}

// Of a log that is cut into parts, those whose rows are held out.
TEST_F(ForwardGapTest, TimesOfHeldOutRowsCount) {
  const std::vector<GapSegment> segments = {Segment()};
  const GapRows rows(segments, kBandwidth, LogPart::Fold(2));
  const CountedTimes counted = TimesWithRows(rows);
  EXPECT_TRUE(counted(0, 2));     // in the third tenth of 8 s
  EXPECT_FALSE(counted(0, 1.2));  // in the second
  EXPECT_FALSE(counted(1, 2));
}

// An unstable robot: infinitely far off, and nothing is thrown.
TEST_F(ForwardGapTest, ADivergingRobotIsAResult) {
  ForwardRobots robots = Robots();
  robots.after.plant.joint_laws.push_back(
      {0, {}, false, [](const ArmInstant& at, const double*, double*) {
         return 1e3 * at.velocity[0];
       }});
  const ForwardGap gap = InLoop(robots);
  EXPECT_EQ(gap.diverged[0], 0);
  EXPECT_EQ(gap.diverged[2], 1);
  EXPECT_TRUE(std::isinf(gap.figures.after));
  EXPECT_TRUE(std::isfinite(gap.figures.refit));
}

}  // namespace armcal::forward_test
