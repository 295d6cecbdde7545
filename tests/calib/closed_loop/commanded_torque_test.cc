#include "calib/closed_loop/commanded_torque.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/commanded_arm.h"

namespace armcal::commanded_torque_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The torque that Simbody's arm was given is in its log, which is held against
// what is made of command and encoders alone, in shares of its rms.
double Misfit(const ControllerOptions& controller, const Robot& truth,
              double noise) {
  CommandedLog log = RecordCommands(truth, controller, 8, {noise, noise});
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

// Logs lose rows, a few at a time: only the torque near these is worse.
TEST(CommandedTorque, OfLogsThatLoseRows) {
  const Robot truth = CommandedTruth(3);
  ControllerOptions controller = CommandedController(truth);
  controller.feedforward = Feedforward::kInverseDynamics;
  CommandedLog whole = RecordCommands(truth, controller, 8, {1e-6, 1e-6});
  std::vector<int> kept;
  for (int k = 0; k < whole.log.size(); ++k) {
    if (k % 50 >= 5 || k % 3 == 0) kept.push_back(k);
  }
  CommandedLog log = whole;
  log.log.t = whole.log.t(kept);
  log.log.q = whole.log.q(kept, Eigen::all);
  log.log.qref = whole.log.qref(kept, Eigen::all);
  controller.delay += kCommandDelay;
  MatrixXd error = CommandedTorque(truth, controller, log, log.log.t) -
                   whole.log.tau(kept, Eigen::all);
  const int first = FirstCounted(log.log);
  error = error.bottomRows(error.rows() - first).eval();
  error.rowwise() -= error.colwise().mean().eval();
  for (int j = 0; j < 3; ++j) {
    EXPECT_LT(error.col(j).cwiseAbs().maxCoeff(),
              .015 * whole.log.tau.col(j).cwiseAbs().maxCoeff())
        << j;
  }
}

// Positions shake by what their encoders do, at even times or not; what torques
// make of it is held against Simbody in diagnose_data_position_noise_test.
TEST(CommandedTorque, KnowsTheNoiseOfPositions) {
  const Robot truth = CommandedTruth(3);
  const ControllerOptions controller = CommandedController(truth);
  CommandedLog log = RecordCommands(truth, controller, 20, kUsualEncoder);
  const double stddev =
      std::hypot(kUsualEncoder.noise, kUsualEncoder.resolution / std::sqrt(12));
  std::vector<int> kept;
  for (int k = 0; k < log.log.size(); ++k) {
    if (k % 7 != 3) kept.push_back(k);
  }
  for (const bool uneven : {false, true}) {
    if (uneven) {
      log.log.t = VectorXd(log.log.t(kept));
      log.log.q = MatrixXd(log.log.q(kept, Eigen::all));
      log.log.qref = MatrixXd(log.log.qref(kept, Eigen::all));
    }
    const ReconstructedTorque reconstructed =
        ReconstructTorque(truth, controller, log, log.log.t, 1);
    EXPECT_EQ(reconstructed.t, log.log.t);
    EXPECT_EQ(reconstructed.torque_noise.rows(), log.log.size());
    for (int j = 0; j < 3; ++j) {
      const auto x = reconstructed.position_noise.col(j);
      // Differences of rows of which one is missing hold some of the motion.
      EXPECT_NEAR(x.norm() / std::sqrt(x.size()) / stddev, 1, uneven ? .25 : .2)
          << j;
    }
  }
}

// Stamps of a clock that is 2 % fast.
TEST(CommandedTorque, KnowsWhatItsClockMakes) {
  const Robot truth = CommandedTruth(3);
  ControllerOptions controller = CommandedController(truth);
  CommandedLog log = RecordCommands(truth, controller, 8, {0, 0});
  controller.delay += kCommandDelay;
  log.log.t *= 1.02;
  const ReconstructedTorque reconstructed =
      ReconstructTorque(truth, controller, log, log.log.t, 1);
  const long rows = reconstructed.tau.rows() - FirstCounted(log.log);
  MatrixXd error = (reconstructed.tau - log.log.tau).bottomRows(rows);
  MatrixXd left = error - .02 * reconstructed.by_rate.bottomRows(rows);
  for (MatrixXd* x : {&error, &left}) {
    x->rowwise() -= x->colwise().mean().eval();
  }
  EXPECT_LT(left.norm(), .3 * error.norm());
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

}  // namespace armcal::commanded_torque_test
