#include "calib/closed_loop/tangent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/closed_loop/noise.h"
#include "calib/closed_loop/unknowns.h"
#include "tests/fixtures/exact_rollout.h"
#include "tests/fixtures/random_motion.h"

namespace armcal::tangent_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
  values.drives = controller.drives;
  values.delay = .003;
  values.substeps = 8;
  return values;
}

// By LoopOrder: terms, widths, gains and delay are free, and links if wanted.
std::vector<bool> Free(const ControllerOptions& controller, bool links) {
  const int n = static_cast<int>(controller.drives.size());
  const LoopOrder order(n);
  std::vector<bool> free(order.size(), true);
  std::fill_n(free.begin(), order.terms(), links);
  int k = order.gains();
  for (double DriveLaw::*gain : EstimatedGains()) {
    for (const DriveLaw& drive : controller.drives) {
      free[k++] = drive.*gain > 0;
    }
  }
  return free;
}

// Every derivative of a closed loop against differences of order 4 of the loop
// itself: 2 % with periods of 2 ms.
void ExpectDerivatives(const Robot& robot, ControllerOptions controller) {
  const int n = robot.num_joints();
  const CommandedLog log = LogOf(n, 40, .0051);
  const CommandedReference reference(robot, controller.feedforward, log);
  const LoopValues values = ValuesOf(robot, controller);
  const LoopUnknowns unknowns(values, controller.kind, {},
                              {JointTerm::kViscous, JointTerm::kCoulomb},
                              VectorXd::Ones(n));
  const LoopColumns columns(robot, Free(controller, true));
  const LoopOrder order(n);
  const LoopStretch stretch(log.log, reference, 0, log.log.size(),
                            1 / controller.rate_hz);
  std::mt19937_64 random(3);
  VectorXd x(order.size() + 3 * n);
  x << unknowns.Stack(values), UniformVector(&random, 3 * n, -.2, .2);
  const auto track = [&](const VectorXd& at) {
    const VectorXd s = at.tail(3 * n);
    return SimulateLoop(controller, unknowns.At(at.head(order.size())),
                        {&stretch},
                        {{s.head(n), s.segment(n, n), s.tail(n)}})[0];
  };
  const LoopTrack about = track(x);
  ASSERT_TRUE(about.finite);
  const LoopTangent tangent =
      LineariseLoop(controller, values, columns, stretch, about, false);
  MatrixXd by_values(tangent.by_columns.rows(), x.size());
  by_values << tangent.by_columns.leftCols(columns.num_values()) *
                   columns.spread(),
      tangent.by_columns.rightCols(3 * n);
  for (int c = 0; c < x.size(); ++c) {
    if (c < order.size() && columns.spread().col(c).isZero()) continue;
    const bool gain = c >= order.gains() && c < order.delay();
    const double h = gain ? 1e-3 * std::max(x[c], .01) : 2e-4;
    const auto at = [&](double change) {
      VectorXd moved = x;
      moved[c] += change;
      return track(moved).Residual(stretch);
    };
    // Residuals fall as positions grow.
    const VectorXd slope =
        -(8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    const double size = slope.cwiseAbs().maxCoeff();
    EXPECT_LT((by_values.col(c) - slope).cwiseAbs().maxCoeff(),
              .02 * size + 1e-9)
        << n << " joints, column " << c;
  }
}

Robot Rubbing(int n) {
  std::mt19937_64 random(4);
  Robot robot = ArmWithFrames(n, n, &random);
  for (Link& link : robot.links) {
    link.joint.viscous = Uniform(&random, .1, .5);
    link.joint.coulomb = Uniform(&random, .1, .5);
    link.joint.armature = Uniform(&random, .5, 1);
  }
  return robot;
}

TEST(LoopTangentTest, IsTheDerivativeOfTheLoop) {
  for (const int n : {1, 3}) {
    ExpectDerivatives(Rubbing(n), Gains(n, 900, 60, 2000));
  }
}

TEST(LoopTangentTest, OfCascadesWithLagsAndLimits) {
  ControllerOptions controller = Gains(3, 0, 60, 0);
  controller.kind = DriveKind::kCascade;
  for (DriveLaw& drive : controller.drives) {
    drive.position_gain = 15;
    drive.velocity_ki = 500;
    drive.lag = .004;
    drive.velocity_limit = .9;
  }
  controller.drives[1].torque_limit = 20;
  ExpectDerivatives(Rubbing(3), controller);
}

// A block on a slide under P, I and D on a filtered difference, linear and in
// closed form: what an error of the encoder at each period does to all later
// positions, impulse by impulse.
TEST(LoopTangentTest, NoiseGoesRoundTheLoop) {
  constexpr int kPeriods = 60;
  const double m = 2, d = 3, noise = 1e-4;
  Robot robot = HorizontalSlide(m);
  robot.links[0].joint.viscous = d;
  robot.gravity.setZero();
  const ControllerOptions controller = Gains(1, 4000, 150, 20000);
  const double T = 1 / controller.rate_hz;
  const CommandedLog log = LogOf(1, kPeriods, T);
  const CommandedReference reference(robot, controller.feedforward, log);
  const LoopStretch stretch(log.log, reference, 0, kPeriods, T);
  const LoopValues values = ValuesOf(robot, controller);
  const LoopTrack track = SimulateLoop(
      controller, values, {&stretch},
      {{VectorXd::Zero(1), VectorXd::Zero(1), VectorXd::Zero(1)}})[0];
  const LoopColumns columns(robot, Free(controller, false));
  const std::vector<MatrixXd> periods =
      LineariseLoop(controller, values, columns, stretch, track, true).periods;

  const double decay = std::exp(-d * T / m);
  const double filter = std::exp(-2 * M_PI * controller.velocity_filter_hz * T);
  const DriveLaw& drive = controller.drives[0];
  MatrixXd L = MatrixXd::Identity(kPeriods, kPeriods);
  for (int i = 0; i < kPeriods; ++i) {
    double q = 0, v = 0, last = 0, differenced = 0, integral = 0;
    for (int k = i; k < kPeriods; ++k) {
      L(k, i) += q;
      const double seen = q + (k == i ? 1 : 0);
      differenced = filter * differenced + (1 - filter) / T * (seen - last);
      const double force = -drive.kp * seen - drive.kd * differenced + integral;
      integral -= drive.ki * T * seen;
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
  const MatrixXd found =
      LoopNoiseCovariance(controller, values, stretch, track, periods,
                          VectorXd::Constant(1, noise), weights);
  EXPECT_LT((found - expected).norm(), 1e-4 * expected.norm());
  // It is not the encoder's noise alone.
  const MatrixXd alone = noise * noise * weights.transpose() * weights;
  EXPECT_GT((found - alone).norm(), .05 * alone.norm());
}

}  // namespace armcal::tangent_test
