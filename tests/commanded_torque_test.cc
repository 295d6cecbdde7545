#include "calib/commanded_torque.h"

#include <gtest/gtest.h>

#include "tests/commanded_arm.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The torque that Simbody's arm was given is in its log, which is held against
// what is made of command and encoders alone, in shares of its rms.
double Misfit(const ControllerOptions& controller, const Robot& truth,
              double noise) {
  CommandedLog log = RecordCommands(truth, controller, 8, noise);
  const MatrixXd given = log.log.tau;
  log.log.tau.resize(0, 0);
  ControllerOptions late = controller;
  late.delay += kCommandDelay;
  const MatrixXd made = CommandedTorque(truth, late, log, log.log.t);
  const int first = FirstCounted(log.log);
  const long rows = given.rows() - first - 1;
  // But for what integrals had at the begin.
  MatrixXd error = (made - given).middleRows(first, rows);
  error.rowwise() -= error.colwise().mean().eval();
  return error.norm() / given.middleRows(first, rows).norm();
}

TEST(CommandedTorque, IsWhatTheDrivesGave) {
  const Robot truth = CommandedTruth(3);
  ControllerOptions controller = CommandedController(truth);
  EXPECT_LT(Misfit(controller, truth, 0), .01);
  EXPECT_LT(Misfit(controller, truth, 1e-5), .05);
  controller.feedforward = Feedforward::kInverseDynamics;
  EXPECT_LT(Misfit(controller, truth, 0), .01);
  controller.feedforward = Feedforward::kNone;
  for (DriveLaw& drive : controller.drives) drive.torque_limit = 4;
  EXPECT_LT(Misfit(controller, truth, 0), .02);
}

// Velocity loops in position loops.
TEST(CommandedTorque, OfCascades) {
  const Robot truth = CommandedTruth(3);
  ControllerOptions controller =
      DefaultController(truth, VectorXd::Zero(3), 8, DriveKind::kCascade);
  for (DriveLaw& drive : controller.drives) drive.torque_limit = 1e9;
  EXPECT_LT(Misfit(controller, truth, 0), .01);
}

// A step through a lag of time constant T: 1 - exp(-t/T), and its means.
TEST(CommandedTorque, LagsBehind) {
  ControllerOptions controller;
  controller.feedforward = Feedforward::kNone;
  DriveLaw drive;
  drive.kp = 1;
  drive.lag = .02;
  controller.drives = {drive};
  CommandedLog log{"made", {}};
  const int rows = 201;
  log.log.t = VectorXd::LinSpaced(rows, 0, .2);
  log.log.q = MatrixXd::Zero(rows, 1);
  log.log.qref = MatrixXd::Zero(rows, 1);
  log.log.qref.bottomRows(101).setOnes();
  const MatrixXd made =
      CommandedTorque(CommandedTruth(1), controller, log, log.log.t);
  for (int k = 105; k < 195; ++k) {
    EXPECT_NEAR(made(k, 0), 1 - std::exp(-(log.log.t[k] - .1) / drive.lag),
                2e-3)
        << k;
  }
}

}  // namespace
}  // namespace armcal
