#include "tests/blind/structured_misfit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/blind/blind_case.h"

namespace armcal::structured_misfit_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double Rms(const VectorXd& x) { return std::sqrt(x.squaredNorm() / x.size()); }

ScenarioRun QuietRun(const BlindCase& blind, BlindLog log) {
  return RunScenario(QuietScenario(blind, log, {}), ScenarioEngine::kRigidArm);
}

// A case without effects, its quiet training log without the misfit, and its
// misfit.
struct MisfitCase {
  BlindCase without, with;
  ScenarioRun run;

  explicit MisfitCase(uint64_t seed)
      : without(DrawBlindCase(seed, PlanCase(Stratum::kNoneRich, 0))),
        with(without),
        run(QuietRun(without, BlindLog::kTraining)) {
    with.misfit =
        DrawMisfit(seed, 0, without.robot, without.zero_velocity, run.run.log);
  }
};

VectorXd Ripple(const MisfitCase& drawn, int j, const VectorXd& q) {
  const JointType type = drawn.with.robot.links[j].joint.type;
  const auto& joint = drawn.with.misfit->joints[j];
  return q.unaryExpr([&](double x) { return RippleTorque(joint, type, x); });
}

VectorXd Drift(const MisfitCase& drawn, BlindLog log, int j,
               const VectorXd& share) {
  const VectorXd waves =
      DriftOf(*drawn.with.misfit, static_cast<uint64_t>(log)).row(j);
  return share.unaryExpr([&](double s) { return DriftTorque(waves, s); });
}

TEST(StructuredMisfit, HasItsSharesOfTheUsualTorque) {
  double squares = 0;
  int joints = 0;
  for (const uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const MisfitCase drawn(seed);
    const Log& log = drawn.run.run.log;
    for (int j = 0; j < log.q.cols(); ++j, ++joints) {
      const double usual = Rms(log.tau.col(j));
      EXPECT_NEAR(Rms(Ripple(drawn, j, log.q.col(j))), .02 * usual,
                  1e-9 * usual);
      const VectorXd share = VectorXd::LinSpaced(2000, 0, 1);
      EXPECT_NEAR(Rms(Drift(drawn, BlindLog::kTraining, j, share)), .01 * usual,
                  1e-4 * usual);
      squares += std::pow(
          drawn.with.misfit->joints[j].torque_factor / .03 - 1 / .03, 2);
      for (const auto& ripple : drawn.with.misfit->joints[j].ripples) {
        EXPECT_GE(ripple.cycles, 1);
        EXPECT_LT(ripple.cycles, 6);
      }
    }
  }
  EXPECT_NEAR(squares / joints, 1, 4 * std::sqrt(2. / joints));
}

// Recorded is what the drive gives without misfit, and what the plant lacks by
// hand, times the factor. Friction is left out where it changes sign.
TEST(StructuredMisfit, IsInTheRecordedTorque) {
  const MisfitCase drawn(7);
  const Log& before = drawn.run.run.log;
  const Log after = QuietRun(drawn.with, BlindLog::kTraining).run.log;
  ASSERT_EQ(before.size(), after.size());
  const VectorXd share = after.t / after.t[after.size() - 1];
  for (int j = 0; j < before.q.cols(); ++j) {
    const Joint& joint = drawn.run.robot.links[j].joint;
    const double width =
        drawn.without.zero_velocity * (IsRotational(joint.type) ? 1 : .3);
    const auto& misfit = drawn.with.misfit->joints[j];
    const VectorXd ripple = Ripple(drawn, j, after.q.col(j)),
                   drift = Drift(drawn, BlindLog::kTraining, j, share);
    double left = 0, all = 0;
    for (int k = 0; k < after.size(); ++k) {
      const double v = after.qd(k, j), u = v / width;
      if (std::abs(u) < 10) continue;
      const double friction =
          joint.coulomb *
          (2 / M_PI * std::atan(M_PI / 2 * u) - u / std::sqrt(1 + u * u));
      const double added =
          after.tau(k, j) / misfit.torque_factor - before.tau(k, j);
      all += added * added;
      left += std::pow(added - ripple[k] - drift[k] - friction, 2);
    }
    EXPECT_LT(left, .02 * all) << "joint " << j;
  }
}

// Of the laws of joint j at rest or in motion.
double LawTorque(const SimulatedRobot& robot, int j, double q, double qd) {
  const long n = robot.robot.num_joints();
  ArmInstant at;
  at.position = VectorXd::Constant(n, q);
  at.velocity = VectorXd::Constant(n, qd);
  double torque = 0;
  for (const JointLaw& law : robot.joint_laws) {
    if (law.joint == j) torque += law.torque(at, nullptr, nullptr);
  }
  return torque;
}

// What a stand that sways puts under the base is no driven joint.
TEST(StructuredMisfit, IsOfTheDrivenJoints) {
  const MisfitCase drawn(8);
  const auto plant = PlantMisfit(*drawn.with.misfit, 0, 10);
  SimulatedRobot fixed, sways;
  fixed.robot = sways.robot = drawn.with.robot;
  sways.robot.links.insert(sways.robot.links.begin(), Link());
  sways.num_passive = 1;
  plant(&fixed);
  plant(&sways);
  const int n = drawn.with.robot.num_joints();
  VectorXd torque = VectorXd::Ones(n), with_base = VectorXd::Ones(n + 1);
  fixed.actuators[0].apply({}, nullptr, nullptr, &torque);
  sways.actuators[0].apply({}, nullptr, nullptr, &with_base);
  ASSERT_EQ(with_base.size(), n + 1);
  EXPECT_EQ(with_base[0], 1);
  EXPECT_EQ(with_base.tail(n), torque);
  EXPECT_EQ(LawTorque(sways, 0, .7, .3), 0);
  for (int j = 0; j < n; ++j) {
    EXPECT_EQ(LawTorque(sways, j + 1, .7, .3), LawTorque(fixed, j, .7, .3));
  }
}

TEST(StructuredMisfit, IsTheRobotsInAllLogsExceptTheDrift) {
  const MisfitCase drawn(8);
  const int n = drawn.with.robot.num_joints();
  const VectorXd start = VectorXd::Zero(1);
  for (const BlindLog log : {BlindLog::kValidation, BlindLog::kReference}) {
    const SimulatedRobot robot = TrueRobot(BlindScenario(drawn.with, log, {})),
                         trained = TrueRobot(BlindScenario(
                             drawn.with, BlindLog::kTraining, {}));
    VectorXd torque = VectorXd::Ones(n), same = VectorXd::Ones(n);
    robot.actuators[0].apply({}, nullptr, nullptr, &torque);
    trained.actuators[0].apply({}, nullptr, nullptr, &same);
    EXPECT_EQ(torque, same);
    for (int j = 0; j < n; ++j) {
      EXPECT_EQ(torque[j], 1 / drawn.with.misfit->joints[j].torque_factor);
      const double drift = Drift(drawn, log, j, start)[0],
                   other = Drift(drawn, BlindLog::kTraining, j, start)[0];
      EXPECT_NE(drift, other);
      for (const double q : {-.7, .1, 1.3}) {
        EXPECT_NEAR(LawTorque(robot, j, q, .4 * q) + drift,
                    LawTorque(trained, j, q, .4 * q) + other, 1e-9);
      }
    }
  }
}

// The robot, its motion, when it is sampled: as without.
TEST(StructuredMisfit, LeavesOtherRandomStreamsAlone) {
  const MisfitCase drawn(9);
  BlindCase with = drawn.with, without = drawn.without;
  with.sensors.jitter = without.sensors.jitter = 5e-4;
  with.sensors.lost_share = without.sensors.lost_share = .01;
  const auto run = [](const BlindCase& blind) {
    return RunScenario(BlindScenario(blind, BlindLog::kValidation, {}),
                       ScenarioEngine::kRigidArm);
  };
  const ScenarioRun a = run(without), b = run(with);
  EXPECT_EQ(a.run.log.t, b.run.log.t);
  EXPECT_EQ(a.run.log.qref, b.run.log.qref);
  for (int j = 0; j < a.robot.num_joints(); ++j) {
    EXPECT_EQ(a.robot.links[j].inertial.ToVector(),
              b.robot.links[j].inertial.ToVector());
    EXPECT_EQ(a.robot.links[j].joint.coulomb, b.robot.links[j].joint.coulomb);
  }
  EXPECT_NE(a.run.log.tau, b.run.log.tau);
}

TEST(StructuredMisfit, IsTheSameForTheSameSeed) {
  const MisfitCase drawn(10);
  const auto draw = [&](uint64_t seed) {
    return ToJson(
        DrawMisfit(seed, 0, drawn.with.robot, .005, drawn.run.run.log),
        {"training"});
  };
  EXPECT_EQ(draw(10), draw(10));
  EXPECT_NE(draw(10), draw(11));
}

}  // namespace armcal::structured_misfit_test
