#include "calib/diagnose/data/baseline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/fixtures/gap_segment.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::baseline_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = BaselineColumn::Kind;

constexpr double kBandwidth = 8;  // Hz
constexpr double kStep = .004;    // s

// Along the exact motion of an arm, every column against the change of the
// nominal torque that its parameter makes.
class GapBaselineTest : public testing::TestWithParam<std::string> {
 protected:
  GapBaselineTest() : robot_(SampleRobot(GetParam())) {
    SetRandomInertials(&random_, &robot_);
    for (Link& link : robot_.links) {
      link.joint.armature = .2;
      link.joint.viscous = .8;
      link.joint.coulomb = 1.5;
      link.joint.offset = -.3;
    }
    path_ = RandomMultisine(&random_, n());
    segments_ = {Segment(0), Segment(40)};
    rows_.emplace(segments_, kBandwidth);
    baseline_.emplace(robot_, BaselineOptions(), VectorXd::Constant(n(), 10));
  }
  int n() const { return robot_.num_joints(); }

  // The motion from `begin` s on.
  GapSegment Segment(double begin) const {
    Multisine path = path_;
    path.phase += begin * path.omega;
    Log log = RecordMotion(path, 8, kStep);
    log.tau = MatrixXd::Zero(log.size(), n());
    GapSegment segment = MakeSegment(log);
    segment.motion.torque = {};  // whose delay it would show
    return segment;
  }
  // Thinned torque of joint j of a robot along the motion, `later` s later.
  VectorXd Torque(const Robot& robot,
                  const std::vector<CoulombTransition>& transitions, int j,
                  double later = 0) const {
    VectorXd thin(rows_->num_thin());
    for (int s = 0; s < 2; ++s) {
      const RecordedTorque torque(robot, transitions,
                                  Segment(40 * s + later).motion);
      const VectorXd part = rows_->Thin(s, torque.nominal().col(j));
      thin.segment(rows_->thin_begin(s), part.size()) = part;
    }
    return thin;
  }
  VectorXd Torque(const Robot& robot, int j) const {
    return Torque(robot, baseline_->transitions(), j);
  }
  VectorXd Change(const Robot& robot, int j) const {
    return Torque(robot, j) - Torque(robot_, j);
  }

  std::mt19937_64 random_{11};
  Robot robot_;
  Multisine path_;
  std::vector<GapSegment> segments_;
  std::optional<GapRows> rows_;
  std::optional<GapBaseline> baseline_;
};

// Torque is linear in all that stays in the robot: one column at a time.
TEST_P(GapBaselineTest, ColumnsAreWhatTheirParametersChange) {
  const auto thin =
      baseline_->ThinColumns(*rows_, RecordedTorques(*baseline_, *rows_));
  ASSERT_EQ(static_cast<int>(thin.size()), n());
  for (int c = 0; c < baseline_->size(); ++c) {
    const BaselineColumn& column = baseline_->columns()[c];
    if (column.kind != Kind::kInertial && column.kind != Kind::kTerm) continue;
    const Robot changed = baseline_->With(VectorXd::Unit(baseline_->size(), c));
    for (int j = 0; j < n(); ++j) {
      const VectorXd expected = Change(changed, j);
      EXPECT_LT((thin[j].Select({c}) - expected).norm(),
                1e-3 * expected.norm() + 1e-9)
          << "column " << c << ", joint " << j + 1;
    }
  }
}

// Of a friction of 1.5, half may change sign otherwise.
TEST_P(GapBaselineTest, FrictionMayChangeSignWithinOtherWidths) {
  const auto thin =
      baseline_->ThinColumns(*rows_, RecordedTorques(*baseline_, *rows_));
  const std::vector<double> widths = {1.5e-3, 3e-3, 12e-3, 24e-3, 48e-3};
  int other_widths = 0;
  for (int c = 0; c < baseline_->size(); ++c) {
    const BaselineColumn& column = baseline_->columns()[c];
    if (column.kind != Kind::kZeroVelocity) continue;
    const int j = column.joint;
    const auto usual = baseline_->transitions();
    auto other = usual;
    const double unit = IsRotational(robot_.links[j].joint.type) ? 1 : .3;
    EXPECT_NEAR(usual[j].width, 6e-3 * unit, 1e-12);
    other[j].width = widths[column.index] * unit;
    const VectorXd expected =
        (Torque(robot_, other, j) - Torque(robot_, usual, j)) / 2;
    EXPECT_LT((thin[j].Select({c}) - expected).norm(), 1e-6 * expected.norm())
        << c;
    EXPECT_EQ(thin[(j + 1) % n()].Select({c}).norm(), 0) << c;
    ++other_widths;
  }
  EXPECT_EQ(other_widths, 5 * n());
}

// Torque that is recorded 0.5 ms late is that of the motion 0.5 ms before.
TEST_P(GapBaselineTest, TimingIsTheTorqueOfOtherTimes) {
  for (Link& link : robot_.links) link.joint.coulomb = 0;  // smooth
  const GapBaseline smooth(robot_, {}, VectorXd::Constant(n(), 10));
  const auto thin = smooth.ThinColumns(*rows_, RecordedTorques(smooth, *rows_));
  const int c = smooth.size() - 1;
  ASSERT_EQ(smooth.columns()[c].kind, Kind::kTiming);
  for (int j = 0; j < n(); ++j) {
    const VectorXd late = Torque(robot_, smooth.transitions(), j, -5e-4);
    const VectorXd expected = late - Torque(robot_, smooth.transitions(), j);
    ASSERT_GT(expected.norm(), 0);
    EXPECT_LT((thin[j].Select({c}) - expected).norm(), .01 * expected.norm())
        << j;
  }
}

// Friction of 1.5 that changes sign 2 ms later than the velocity does.
TEST_P(GapBaselineTest, FrictionMayChangeSignAtOtherTimes) {
  BaselineOptions options;
  options.reversal_s = .002;
  const GapBaseline turning(robot_, options, VectorXd::Constant(n(), 10));
  const auto thin =
      turning.ThinColumns(*rows_, RecordedTorques(turning, *rows_));
  Robot slippery = robot_;
  for (Link& link : slippery.links) link.joint.coulomb = 0;
  const auto friction = [&](int j, double later) -> VectorXd {
    return Torque(robot_, turning.transitions(), j, later) -
           Torque(slippery, turning.transitions(), j, later);
  };
  int reversals = 0;
  for (int c = 0; c < turning.size(); ++c) {
    if (turning.columns()[c].kind != Kind::kReversal) continue;
    const int j = turning.columns()[c].joint;
    const VectorXd expected =
        (friction(j, -kStep) - friction(j, kStep)) * (.002 / (2 * kStep));
    EXPECT_LT((thin[j].Select({c}) - expected).norm(), .05 * expected.norm())
        << j;
    EXPECT_EQ(thin[(j + 1) % n()].Select({c}).norm(), 0) << c;
    ++reversals;
  }
  EXPECT_EQ(reversals, n());
}

// By hand: 5 % of the file's numbers, of lengths for the moments.
TEST_P(GapBaselineTest, SpreadsAreTheTrustInTheFile) {
  for (const BaselineColumn& column : baseline_->columns()) {
    if (column.kind == Kind::kInertial) {
      const InertialParameters& body = robot_.links[column.joint].inertial;
      const double size2 = body.inertia.trace() / 2 / body.mass;
      const double share = column.spread / (.05 * body.mass);
      EXPECT_NEAR(share,
                  column.index == 0  ? 1
                  : column.index < 4 ? std::sqrt(size2)
                                     : size2,
                  1e-9);
    } else if (column.kind == Kind::kTerm) {
      const auto term = static_cast<JointTerm>(column.index);
      // Offsets: 2 % of 10 N m is less than the friction of 1.5.
      EXPECT_NEAR(column.spread,
                  .05 * (term == JointTerm::kArmature  ? .2
                         : term == JointTerm::kViscous ? .8
                                                       : 1.5),
                  1e-12);
    } else if (column.kind == Kind::kTiming) {
      EXPECT_EQ(column.spread, 5e-4);
    }
  }
  EXPECT_EQ(baseline_->size(), n() * (10 + 4 + 5) + 1);
}

TEST_P(GapBaselineTest, CoulombFrictionAtItsValuesIsSplitInWidths) {
  const int j = 1;
  VectorXd x = VectorXd::Zero(baseline_->size());
  double own = 1.5, other = 0;
  for (int c = 0; c < baseline_->size(); ++c) {
    const BaselineColumn& column = baseline_->columns()[c];
    if (column.joint != j) continue;
    if (column.kind == Kind::kZeroVelocity && column.index == 3) {
      x[c] = .6;
      other += .6 * column.spread;
    }
    if (column.kind == Kind::kTerm &&
        column.index == static_cast<int>(JointTerm::kCoulomb)) {
      x[c] = 2;
      own += 2 * column.spread;
    }
  }
  x.tail(1)[0] = -3;
  EXPECT_NEAR(baseline_->DelayAt(x), -1.5e-3, 1e-12);
  const std::vector<CoulombPart> parts = baseline_->CoulombAt(j, x);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0].force, own - other, 1e-9);
  EXPECT_NEAR(parts[1].force, other, 1e-9);
  EXPECT_NEAR(parts[1].transition.width / parts[0].transition.width, 4, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Arms, GapBaselineTest,
                         testing::Values("3R elbow", "SCARA RRPR"));

}  // namespace armcal::baseline_test
