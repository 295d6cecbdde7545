#include <gtest/gtest.h>

#include <cmath>

#include "calib/inspect/log_reading.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::single_joint_test {

using Kind = ReadingChange::Kind;

// A bar that hangs from a horizontal axis and swings: 1 kg at .4 m, friction of
// both kinds. Its file is as wrong as placeholders are.
class PendulumTest : public testing::Test {
 protected:
  PendulumTest() {
    Link& bar = robot_.links[0];
    robot_.links.resize(1);
    bar.joint.type = JointType::kRevolute;
    bar.joint.viscous = .1;
    bar.joint.armature = 0;
    robot_.gravity = {0, -9.81, 0};  // across the axis, z of the joint's frame
    Vector10d V;
    V << 1, .4, 0, 0, .01, 0, .18, 0, 0, .18;
    bar.inertial = InertialParameters::FromVector(V);
    Record(10);
    V << .5, .2, 0, 0, .002, 0, .09, 0, 0, .09;
    bar.inertial = InertialParameters::FromVector(V);
  }
  void Record(double duration) {
    std::mt19937_64 random(3);
    log_ = RecordMotion(RandomMultisine(&random, 1), duration, .01);
    AddTorque(robot_, &log_);
    AddCoulomb(0, .2, {CoulombTransition::Law::kVelocity, .02}, &log_);
    AddNoise(&random, .05 * ColumnRms(log_.tau), &log_.tau);
  }
  ReadingFinding Read() const {
    return FindReading(robot_, UniformSeries(log_, .01, .05, 8));
  }

  Robot robot_ = InspectedArm("3R elbow").robot;
  Log log_;
};

TEST_F(PendulumTest, AsItIs) { EXPECT_TRUE(Read().changes.empty()); }

// Half a turn of the joint's zero makes gravity negative, too, but neither
// inertia nor friction.
TEST_F(PendulumTest, ANegatedTorqueIsNoNegativeBody) {
  log_.tau *= -1;
  const ReadingFinding found = Read();
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes[0].kind, Kind::kTorqueSign);
  EXPECT_EQ(found.reading.gravity, robot_.gravity);
}

// The joint may turn the other way then, but no signal is wrong by itself.
TEST_F(PendulumTest, HalfATurnIsNoSign) {
  log_.q.array() += M_PI;
  for (const ReadingChange& change : Read().changes) {
    EXPECT_FALSE(IsOneSign(change.kind) || IsAllSigns(change.kind));
  }
}

// Nothing is asked of a joint that moves for less than a second: gravity that
// would be turned is then a sign that was not asked for.
TEST_F(PendulumTest, OfALogThatIsTooShortNothingIsSaid) {
  const Eigen::Index rows = 80;
  log_.t.conservativeResize(rows);
  for (Eigen::MatrixXd* m : {&log_.q, &log_.qd, &log_.qdd, &log_.tau}) {
    if (m->size() > 0) m->conservativeResize(rows, Eigen::NoChange);
  }
  log_.tau *= -1;
  EXPECT_TRUE(Read().changes.empty());
}

// What a fit has for bodies is none that is negative, whatever the torque.
TEST_F(PendulumTest, AFitHasNoNegativeMassOrMoment) {
  log_.tau *= -1;
  const WiringSamples samples = SamplesAs(
      LogReading(robot_), robot_, UniformSeries(log_, .01, .05, 8), 250);
  const TorqueFit fit(robot_, samples.motion);
  const Eigen::VectorXd x = fit.Parameters(samples.tau);
  for (const int k : {0, 4, 6, 9}) EXPECT_GE(x[k], 0);
  for (const int k : {10, 11, 13}) EXPECT_GE(x[k], 0);  // friction, armature
  // With the torque's own sign it is the bar's, armature included.
  const Eigen::VectorXd right = fit.Parameters(-samples.tau);
  EXPECT_NEAR(right[9] + right[13], .18, .02);
}

}  // namespace armcal::single_joint_test
