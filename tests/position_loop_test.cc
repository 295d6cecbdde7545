#include "calib/position_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/loop_noise.h"
#include "calib/loop_unknowns.h"
#include "tests/exact_rollout.h"
#include "tests/random_motion.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Wanted = PositionLoop::Wanted;

// A log of a smooth command, with rows at the controller's periods and between
// them.
CommandedLog LogOf(int n, int rows, double step) {
  CommandedLog made;
  Log& log = made.log;
  log.t = VectorXd::LinSpaced(rows, 0, (rows - 1) * step);
  log.q.resize(rows, n);
  log.qref.resize(rows, n);
  for (int j = 0; j < n; ++j) {
    log.qref.col(j) = .3 * (3 * (j + 1) * log.t.array()).sin();
    log.q.col(j) = log.qref.col(j) * .9;
  }
  return made;
}

ControllerOptions Gains(int n, double kp, double kd, double ki) {
  ControllerOptions controller;
  controller.rate_hz = 500;
  DriveLaw drive;
  drive.kp = kp;
  drive.kd = kd;
  drive.ki = ki;
  controller.drives.assign(n, drive);
  controller.feedforward = Feedforward::kNone;
  return controller;
}

LoopValues ValuesOf(const Robot& robot, const ControllerOptions& controller) {
  LoopValues values;
  values.arm.robot = robot;
  values.arm.transitions.resize(robot.links.size());
  for (auto& transition : values.arm.transitions) transition.width = .2;
  const auto n = static_cast<Eigen::Index>(controller.drives.size());
  values.kp = VectorXd::Constant(n, controller.drives[0].kp);
  values.kd = VectorXd::Constant(n, controller.drives[0].kd);
  values.ki = VectorXd::Constant(n, controller.drives[0].ki);
  values.delay = .003;
  values.substeps = 8;
  return values;
}

// Every derivative of a closed loop against differences of order 4 of the loop
// itself.
TEST(PositionLoopTest, IsTheDerivativeOfTheLoop) {
  std::mt19937_64 random(4);
  for (const int n : {1, 3}) {
    Robot robot = ArmWithFrames(n, n, &random);
    for (Link& link : robot.links) {
      link.joint.viscous = Uniform(&random, .1, .5);
      link.joint.coulomb = Uniform(&random, .1, .5);
      link.joint.armature = Uniform(&random, .5, 1);
    }
    const ControllerOptions controller = Gains(n, 900, 60, 2000);
    const CommandedLog log = LogOf(n, 40, .0051);
    const CommandedReference reference(robot, controller.feedforward, log);
    const PositionLoop loop(controller, reference, log.log);
    const LoopValues values = ValuesOf(robot, controller);
    const LoopUnknowns unknowns(values, {},
                                {JointTerm::kViscous, JointTerm::kCoulomb},
                                VectorXd::Ones(n));
    const LoopColumns columns(n);
    VectorXd x(columns.size());
    x << unknowns.Stack(values), UniformVector(&random, 3 * n, -.2, .2);
    const auto run = [&](const VectorXd& at, Wanted wanted) {
      const VectorXd s = at.tail(3 * n);
      return loop.Run(unknowns.At(at.head(columns.num_values())),
                      {s.head(n), s.segment(n, n), s.tail(n)}, 0,
                      log.log.size(), wanted);
    };
    const LoopRun exact = run(x, Wanted::kTangents);
    ASSERT_TRUE(exact.finite);
    for (int c = 0; c < columns.size(); ++c) {
      const bool gain = c >= columns.kp() && c < columns.delay();
      const double h = gain ? .1 : 2e-4;
      const auto at = [&](double change) {
        VectorXd moved = x;
        moved[c] += change;
        return run(moved, Wanted::kResidual).residual;
      };
      // The third derivative of the command's spline jumps at its knots.
      const double share = c == columns.delay() ? 1e-5 : 1e-6;
      // Residuals fall as positions grow.
      const VectorXd slope =
          -(8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
      const double size = slope.cwiseAbs().maxCoeff();
      EXPECT_LT((exact.by_values.col(c) - slope).cwiseAbs().maxCoeff(),
                share * size + 1e-9)
          << n << " joints, column " << c;
    }
  }
}

// A block on a slide under P, I and D on a filtered difference, linear and in
// closed form: what an error of the encoder at each period does to all later
// positions, impulse by impulse.
TEST(PositionLoopTest, NoiseGoesRoundTheLoop) {
  constexpr int kPeriods = 60;
  const double m = 2, d = 3, noise = 1e-4;
  Robot robot = HorizontalSlide(m);
  robot.links[0].joint.viscous = d;
  robot.gravity.setZero();
  const ControllerOptions controller = Gains(1, 4000, 150, 20000);
  const double T = 1 / controller.rate_hz;
  const CommandedLog log = LogOf(1, kPeriods, T);
  const CommandedReference reference(robot, controller.feedforward, log);
  const PositionLoop loop(controller, reference, log.log);
  const LoopValues values = ValuesOf(robot, controller);
  const LoopRun run = loop.Run(
      values, {VectorXd::Zero(1), VectorXd::Zero(1), VectorXd::Zero(1)}, 0,
      kPeriods, Wanted::kPeriods);

  const double decay = std::exp(-d * T / m);
  const double filter = std::exp(-2 * M_PI * controller.velocity_filter_hz * T);
  MatrixXd L = MatrixXd::Identity(kPeriods, kPeriods);
  for (int i = 0; i < kPeriods; ++i) {
    double q = 0, v = 0, last = 0, differenced = 0, integral = 0;
    for (int k = i; k < kPeriods; ++k) {
      L(k, i) += q;
      const double seen = q + (k == i ? 1 : 0);
      differenced = filter * differenced + (1 - filter) / T * (seen - last);
      const double force =
          -values.kp[0] * seen - values.kd[0] * differenced + integral;
      integral -= values.ki[0] * T * seen;
      last = seen;
      // m v' = force - d v over a period.
      q += force / d * T + (v - force / d) * (1 - decay) * m / d;
      v = force / d + (v - force / d) * decay;
    }
  }
  std::mt19937_64 random(1);
  const MatrixXd weights = RandomMotion::Random(&random, kPeriods, 3, 1);
  const MatrixXd expected =
      noise * noise * weights.transpose() * L * L.transpose() * weights;
  const MatrixXd found = LoopNoiseCovariance(
      controller, values, run, VectorXd::Constant(1, noise), weights);
  EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm());
  // It is not the encoder's noise alone.
  const MatrixXd alone = noise * noise * weights.transpose() * weights;
  EXPECT_GT((found - alone).norm(), .05 * alone.norm());
}

}  // namespace
}  // namespace armcal
