#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "calib/calibrate.h"
#include "calib/inspect/stuck_rows.h"
#include "calib/reconstructed_torques.h"
#include "calib/verify.h"
#include "calib/verify/verification_report.h"
#include "tests/fixtures/commanded_arm.h"

namespace armcal::mended_commands_test {

using testing::HasSubstr;
using testing::StartsWith;

// A joint in a position loop, whose encoder wraps round, as its commands do,
// or is not answered for a while.
class MendedCommands : public testing::Test {
 protected:
  MendedCommands()
      : truth_(CommandedTruth(1)), controller_(CommandedController(truth_)) {
    log_ = RecordCommands(truth_, controller_, 8, kUsualEncoder).log;
    const DriveLaw& drive = controller_.drives[0];
    path_ =
        WriteFile("rate: " + std::to_string(controller_.rate_hz) +
                      "\nfeedforward: none\nkp: [" + std::to_string(drive.kp) +
                      "]\nkd: [" + std::to_string(drive.kd) + "]\nki: [" +
                      std::to_string(drive.ki) + "]\ndelay: " +
                      std::to_string(kCommandDelay) + "\ntorque_limit: [1e9]\n",
                  "controller.yaml");
    log_.tau.resize(0, 0);
    wrapped_ = log_;
    const double middle = log_.q.col(0).mean();
    const auto wrap = [middle](double limit, Eigen::MatrixXd* x) {
      for (double& q : x->col(0)) q = q > middle + limit ? q - 2 * M_PI : q;
    };
    wrap(.02, &wrapped_.q);
    wrap(.03, &wrapped_.qref);
    int at = 300;  // where the joint goes far in kStuck rows
    for (int k = 300; k + kStuck + 300 < log_.size(); ++k) {
      at = Gone(k) > Gone(at) ? k : at;
    }
    stuck_ = log_;
    stuck_.q.col(0).segment(at, kStuck).setConstant(log_.q(at, 0));
  }

  double Gone(int k) const {
    return std::abs(log_.q(k + kStuck, 0) - log_.q(k, 0));
  }
  CalibrateSummary Calibrated(const Log& log) const {
    CalibrateOptions options;
    options.commands = CommandedCalibrationOptions();
    options.commands->controller = path_;
    return Calibrate(FileOf(truth_), {{LogSource("log.csv", log)}, {}},
                     options);
  }
  VerifySummary Verified(const Log& log) const {
    VerifyOptions options;
    options.controller = path_;
    return Verify(truth_, {{LogSource("log.csv", log)}, {}}, options);
  }
  static double DeviationOf(const VerifySummary& verified) {
    return verified.details->closed_loop->joints[0].before_rms;
  }

  static constexpr int kStuck = 40;
  Robot truth_;
  ControllerOptions controller_;
  std::string path_;
  Log log_, wrapped_, stuck_;
};

TEST_F(MendedCommands, ACalibrationIsAsOfTheRightLog) {
  const CalibrateSummary right = Calibrated(log_);
  for (const Log* log : {&wrapped_, &stuck_}) {
    const CalibrateSummary mended = Calibrated(*log);
    EXPECT_THAT(mended.report,
                StartsWith("warning    of log.csv the position of joint1 "));
    EXPECT_THAT(mended.json, HasSubstr("\"warnings\""));
    ASSERT_EQ(mended.parameters.size(), right.parameters.size());
    for (size_t k = 0; k < right.parameters.size(); ++k) {
      EXPECT_NEAR(mended.parameters[k].value, right.parameters[k].value,
                  2 * right.parameters[k].stddev + 1e-9)
          << right.parameters[k].name;
    }
  }
  EXPECT_EQ(right.report.find("warning"), std::string::npos);
}

TEST_F(MendedCommands, AVerificationFollowsThem) {
  const double right = DeviationOf(Verified(log_));
  for (const Log* log : {&wrapped_, &stuck_}) {
    const VerifySummary mended = Verified(*log);
    EXPECT_THAT(mended.report,
                StartsWith("warning    of log.csv the position of joint1 "));
    EXPECT_NEAR(DeviationOf(mended), right, .1 * right);
  }
}

// Torques that the drives' law makes of them are those of the right log, but
// at the rows that are left out.
TEST_F(MendedCommands, TorquesAreMadeOfThem) {
  const auto torques = [&](const Log& log) {
    const LogSource source("log.csv", log);
    LogReaderOptions reading;
    reading.joint_names = truth_.JointNames();
    MendPositions(truth_, {{source, {}}}, &reading);
    ReconstructTorques(truth_, path_, {source}, &reading);
    return ReadWholeLog(source, reading).tau;
  };
  const Eigen::MatrixXd right = torques(log_);
  const Eigen::MatrixXd wrapped = torques(wrapped_);
  EXPECT_LT((wrapped - right).norm(), 1e-6 * right.norm());
  const Eigen::MatrixXd stuck = torques(stuck_);
  ASSERT_EQ(stuck.rows(), right.rows() - kStuck);
  EXPECT_LT((stuck.topRows(300) - right.topRows(300)).norm(),
            1e-6 * right.norm());
}

// A limit that nobody gave for this loop is the robot file's.
TEST_F(MendedCommands, ALimitOfTheirTorquesIsTold) {
  const LogSource source("log.csv", log_);
  LogReaderOptions reading;
  reading.joint_names = truth_.JointNames();
  EXPECT_TRUE(ReconstructTorques(truth_, path_, {source}, &reading).empty());
  const Eigen::MatrixXd tau = ReadWholeLog(source, reading).tau;
  reading.reconstructed_torque.clear();
  Robot weak = truth_;
  weak.links[0].joint.effort = .5 * tau.norm() / std::sqrt(tau.size());
  const std::string controller = WriteFile(
      "rate: " + std::to_string(controller_.rate_hz) + "\nfeedforward: none\n" +
          "kp: [" + std::to_string(controller_.drives[0].kp) + "]\nkd: [" +
          std::to_string(controller_.drives[0].kd) + "]\n",
      "weak.yaml");
  const auto told = ReconstructTorques(weak, controller, {source}, &reading);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0].finding, HasSubstr("joint1 stands at its limit"));
  EXPECT_THAT(told[0].evidence, HasSubstr("the robot file's effort limit"));
}

// The drives follow commands of rows whose positions are not known.
TEST_F(MendedCommands, CommandsOfRowsThatAreLeftOutCount) {
  LogReaderOptions reading;
  reading.joint_names = truth_.JointNames();
  reading.left_out["log.csv"] = {{0, 10}, {500, 600}};
  const CommandedLog commanded =
      ReadCommandedLog(LogSource("log.csv", log_), reading, {});
  EXPECT_EQ(commanded.log.size(), log_.size() - 110);
  EXPECT_EQ(commanded.begin, log_.t[10] - log_.t[0]);
  const ReferenceMotion motion = CommandedMotion(commanded);
  const double t = log_.t[550] - log_.t[10];
  EXPECT_NEAR(motion.at(t).q[0], log_.qref(550, 0), 1e-9);
}

}  // namespace armcal::mended_commands_test
