#include "calib/diagnose/candidates/corrected_robot.h"

#include <gmock/gmock.h>

#include <cmath>

#include "calib/closed_loop/replay.h"
#include "model/signals/low_pass.h"
#include "tests/fixtures/corrected_arm.h"
#include "tests/fixtures/sample_motion.h"

namespace armcal::corrected_robot_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 15;  // Hz

// What the plant does along a motion in closed loop, at 1 kHz.
GapSegment Simulate(const CorrectedArm& arm, const CorrectedRobot& robot) {
  const ReferenceMotion motion = arm.Motion(12);
  CommandedLog command;
  Log& log = command.log;
  log.t = VectorXd::LinSpaced(12001, 0, 12);
  log.q = log.tau = MatrixXd::Zero(log.size(), 3);
  log.qref.resize(log.size(), 3);
  for (int k = 0; k < log.size(); ++k) log.qref.row(k) = motion.at(log.t[k]).q;
  const ClosedLoopReplay replay = ReplayClosedLoop(
      robot.plant, robot.delay, arm.file, arm.Controller(), command);
  EXPECT_TRUE(replay.finite);
  GapSegment segment;
  segment.motion.t0 = 1;
  segment.motion.dt = 1e-3;
  segment.motion.q = replay.position;
  segment.motion.qd = Differentiate(replay.position, 1e-3);
  segment.motion.qdd = Differentiate(segment.motion.qd, 1e-3);
  segment.tau = replay.torque;
  segment.still.setConstant(segment.size(), 3, false);
  return segment;
}

// Recorded minus predicted torque, rms of joints over that of the torque. The
// prediction is the regression's: nominal torque and columns.
double Misfit(const GapBaseline& baseline, const VectorXd& x,
              const GapSegment& segment, const MatrixXd& effect = {}) {
  const std::vector<GapSegment> segments = {segment};
  const GapRows rows(segments, kBandwidth);
  const std::vector<RecordedTorque> torques = RecordedTorques(baseline, rows);
  const std::vector<BaselineColumns> columns =
      baseline.ThinColumns(rows, torques);
  const MatrixXd recorded = rows.Thin(0, segment.tau);
  MatrixXd missing = recorded - rows.Thin(0, torques[0].nominal());
  for (int j = 0; j < 3; ++j) missing.col(j) -= columns[j].Times(x);
  if (effect.size() > 0) missing -= rows.Thin(0, effect);
  return missing.norm() / recorded.norm();
}

VectorXd Without(const GapBaseline& baseline, BaselineColumn::Kind kind,
                 VectorXd x) {
  for (int c = 0; c < baseline.size(); ++c) {
    if (baseline.columns()[c].kind == kind) x[c] = 0;
  }
  return x;
}

// Every column of the baseline, nuisances included, is in the simulated robot:
// it records what the regression says, and would not without any kind.
TEST(CorrectedRobot, RecordsWhatTheRegressionPredicts) {
  using Kind = BaselineColumn::Kind;
  const CorrectedArm arm;
  const GapBaseline baseline = arm.Baseline();
  std::mt19937_64 random(3);
  VectorXd x = arm.HeavierLinks(baseline, 1.06);
  for (int c = 0; c < x.size(); ++c) {
    if (baseline.columns()[c].kind == Kind::kInertial) continue;
    x[c] = .7 * Normal(&random);
  }
  for (const double delay : {6e-4, -6e-4}) {
    x[x.size() - 1] = delay / baseline.columns().back().spread;
    const CorrectedRobot robot = MakeCorrectedRobot(baseline, x, {}, arm.scale);
    EXPECT_DOUBLE_EQ(robot.delay, delay);
    const GapSegment segment = Simulate(arm, robot);
    const double misfit = Misfit(baseline, x, segment);
    EXPECT_LT(misfit, 5e-4) << delay;
    for (const Kind kind :
         {Kind::kInertial, Kind::kTerm, Kind::kZeroVelocity, Kind::kTiming}) {
      EXPECT_GT(Misfit(baseline, Without(baseline, kind, x), segment),
                4 * misfit)
          << delay << " " << static_cast<int>(kind);
    }
  }
}

// Torque that is recorded late is in nobody's plant: who replays a log has it.
TEST(CorrectedRobot, HoldsADelayOfTheLogOnce) {
  const CorrectedArm arm;
  const GapBaseline baseline = arm.Baseline();
  VectorXd x = VectorXd::Zero(baseline.size());
  x[x.size() - 1] = 6e-4 / baseline.columns().back().spread;
  GapCandidate late;
  late.effect = FindEffect("delay");
  late.p = VectorXd::Constant(1, -.018);
  const CorrectedRobot robot =
      MakeCorrectedRobot(baseline, x, {late}, arm.scale);
  EXPECT_DOUBLE_EQ(robot.delay, .0186);
  EXPECT_EQ(robot.plant.torque_delay, 0);
  ASSERT_EQ(robot.effects.size(), 1u);
  EXPECT_FALSE(robot.effects[0].in_robot);
}

// By hand: 12 mrad/s is among the widths, and an effect is on top.
TEST(CorrectedRobot, IsTheTruthWrittenByHand) {
  const CorrectedArm arm;
  const GapBaseline baseline = arm.Baseline();
  const CorrectedRobot robot = MakeCorrectedRobot(
      baseline, arm.TrueValues(baseline, 0), {arm.Found()}, arm.scale);
  EXPECT_TRUE(robot.notes.empty());
  const SimulatedRobot truth = arm.Truth(true);
  ArmInstant at;
  for (const double v : {-.4, -.02, -.003, 0., .001, .01, .1, 1.}) {
    at.velocity = VectorXd::Constant(3, v);
    for (int j = 0; j < 3; ++j) {
      const auto torque = [&](const SimulatedRobot& plant) {
        double sum = 0, rate = 0;
        for (const JointLaw& law : plant.joint_laws) {
          if (law.joint == j) sum += law.torque(at, nullptr, &rate);
        }
        return sum;
      };
      EXPECT_NEAR(torque(robot.plant), torque(truth), 1e-12) << j << " " << v;
    }
  }
  EXPECT_NEAR(robot.plant.robot.links[2].joint.armature, arm.kArmature, 1e-12);
}

// Effects that change the joint's own friction instead of adding a law.
TEST(CorrectedRobot, TakesFrictionThatAnEffectGivesToTheJoint) {
  const CorrectedArm arm;
  Effect sticky;
  sticky.apply = [](const EffectSite& site, const VectorXd& p,
                    SimulatedRobot* robot) {
    robot->robot.links[site.joint].joint.coulomb += p[0];
    robot->robot.links[site.joint].joint.offset += p[1];
  };
  GapCandidate found;
  found.effect = &sticky;
  found.joint = 2;
  found.p = Eigen::Vector2d(1.5, -.5);
  const GapBaseline baseline = arm.Baseline();
  const CorrectedRobot robot = MakeCorrectedRobot(
      baseline, VectorXd::Zero(baseline.size()), {found}, arm.scale);
  ArmInstant at;
  at.velocity = VectorXd::Constant(3, 1);
  double sum = 0;
  for (const JointLaw& law : robot.plant.joint_laws) {
    if (law.joint == 2) sum += law.torque(at, nullptr, nullptr);
  }
  EXPECT_NEAR(sum, -3 - 4 - 1.5 + .5, 1e-12);
}

TEST(CorrectedRobot, GivesAYieldingJointAMotorAndSaysSo) {
  CorrectedArm arm;
  arm.file.links[1].joint.armature = 0;
  Effect soft;
  soft.apply = [](const EffectSite& site, const VectorXd&,
                  SimulatedRobot* robot) {
    Transmission spring;
    spring.joint = site.joint;
    spring.torque = [](double d, double, const double*, double*) {
      return 1e4 * d;
    };
    robot->transmissions.push_back(spring);
  };
  GapCandidate found;
  found.effect = &soft;
  found.joint = 1;
  const GapBaseline baseline = arm.Baseline();
  const CorrectedRobot robot = MakeCorrectedRobot(
      baseline, VectorXd::Zero(baseline.size()), {found}, arm.scale);
  EXPECT_GT(robot.plant.robot.links[1].joint.armature, 0);
  ASSERT_EQ(robot.notes.size(), 1u);
  EXPECT_THAT(robot.notes[0],
              testing::HasSubstr("yields but has no armature: simulated with"));
}

}  // namespace armcal::corrected_robot_test
