// Currents of motors behind gears of known friction, written by hand.

#include "calib/drive_trains/drive_train.h"

#include <gmock/gmock.h>

#include "calib/drive_trains/report.h"
#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::drive_train_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;

constexpr double kDuration = 20, kStep = .004;  // s

struct Drives {
  Robot robot = SampleRobot("UR5 6R");
  MatrixXd truth;  // joints x DriveTrain::kUnknowns

  explicit Drives(std::mt19937_64* random) {
    SetRandomInertials(random, &robot);
    truth.resize(6, DriveTrain::kUnknowns);
    for (int j = 0; j < 6; ++j) {
      truth.row(j) << Uniform(random, 5, 20), Uniform(random, .1, 1),
          Uniform(random, 1, 5), Uniform(random, 1, 4), Uniform(random, 0, .1),
          Uniform(random, -1, 1);
    }
  }

  // The sign of a velocity by another law than the one that is fitted.
  double Current(int j, double torque, double qd, double qdd) const {
    const auto of = [&](int k) { return truth(j, k); };
    const double sign = qd / std::hypot(qd, .01);
    return (torque + of(DriveTrain::kArmature) * qdd +
            of(DriveTrain::kViscous) * qd +
            (of(DriveTrain::kCoulomb) +
             of(DriveTrain::kLoadFriction) * std::abs(torque)) *
                sign +
            of(DriveTrain::kOffset)) /
           of(DriveTrain::kTorqueConstant);
  }

  // Both with noise of half a percent.
  Log Record(std::mt19937_64* random) const {
    Log log = RecordMotion(RandomMultisine(random, 6), kDuration, kStep);
    log.tau.resize(log.size(), 6);
    for (int k = 0; k < log.size(); ++k) {
      log.tau.row(k) =
          InverseDynamics(robot, log.q.row(k).transpose(),
                          log.qd.row(k).transpose(), log.qdd.row(k).transpose())
              .transpose();
    }
    log.current.resize(log.size(), 6);
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < log.size(); ++k) {
        log.current(k, j) =
            Current(j, log.tau(k, j), log.qd(k, j), log.qdd(k, j));
      }
    }
    AddNoise(random, .005 * ColumnRms(log.tau), &log.tau);
    AddNoise(random, .005 * ColumnRms(log.current), &log.current);
    return log;
  }
};

DriveTrains Estimate(const Robot& robot, Log log) {
  log.qd.resize(0, 0);
  log.qdd.resize(0, 0);
  LogReaderOptions reading;
  reading.joint_names = robot.JointNames();
  reading.want_current = true;
  const LogSet logs({LogSource("log", log)}, reading, TimeRange());
  PreparationOptions preparation;
  preparation.bandwidth_hz = 10;
  return EstimateDriveTrains(robot, {}, Prepare(logs, preparation));
}

// 95 % of the intervals hold the truth, in friction whose sign changes by
// another law than the fitted one's; at least 95 % - 3 deviations of all 720,
// less a few of each unknown.
TEST(DriveTrains, IntervalsHoldTheTruth) {
  constexpr int kRuns = 20, kJoints = 6;
  Eigen::Array<int, DriveTrain::kUnknowns, 1> held;
  held.setZero();
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937_64 random(run);
    const Drives drives(&random);
    const DriveTrains found = Estimate(drives.robot, drives.Record(&random));
    ASSERT_EQ(found.joints.size(), size_t{kJoints});
    for (int j = 0; j < kJoints; ++j) {
      const DriveTrain& drive = found.joints[j];
      ASSERT_EQ(drive.not_told, "");
      ASSERT_TRUE(drive.told.all());
      const VectorXd off = drive.value - drives.truth.row(j).transpose();
      held += (off.array().abs() < 1.96 * drive.stddev.array()).cast<int>();
      EXPECT_LT(drive.stddev[DriveTrain::kTorqueConstant],
                .01 * drive.value[DriveTrain::kTorqueConstant]);
      EXPECT_LT(drive.rms, .02 * drive.current);
    }
  }
  EXPECT_GE(held.sum(), .926 * kRuns * kJoints * DriveTrain::kUnknowns);
  for (int k = 0; k < DriveTrain::kUnknowns; ++k) {
    EXPECT_GE(held[k], .87 * kRuns * kJoints) << "unknown " << k;
  }
  RecordProperty("held_of_720", held.sum());
}

// Half a second of nonsense in the currents moves nothing by more than an
// interval allows for.
TEST(DriveTrains, SpikesDoNotPull) {
  std::mt19937_64 random(1);
  const Drives drives(&random);
  Log log = drives.Record(&random);
  log.current.middleRows(2000, 125).array() += 5;
  const DriveTrains found = Estimate(drives.robot, log);
  for (int j = 0; j < 6; ++j) {
    const VectorXd off =
        found.joints[j].value - drives.truth.row(j).transpose();
    for (int k = 0; k < DriveTrain::kUnknowns; ++k) {
      EXPECT_LT(std::abs(off[k]), 4 * found.joints[j].stddev[k]) << j << k;
    }
  }
}

TEST(DriveTrains, SaysWhatCannotBeTold) {
  std::mt19937_64 random(1);
  const Drives drives(&random);
  Log log = drives.Record(&random);
  log.q.col(1).setConstant(.3);
  log.tau.col(3) = 8 * log.current.col(3);
  log.current.col(4).setConstant(.2);
  const DriveTrains found = Estimate(drives.robot, log);
  EXPECT_EQ(found.joints[0].not_told, "");
  EXPECT_THAT(found.joints[1].not_told, HasSubstr("does not move"));
  EXPECT_THAT(found.joints[3].not_told, HasSubstr("no sensor"));
  EXPECT_THAT(found.joints[4].not_told, HasSubstr("constant"));
  const nlohmann::json json = DriveTrainsJson(found);
  EXPECT_EQ(json["joints"].size(), 6u);
  EXPECT_TRUE(json["joints"][0].contains("load_coefficient_stddev"));
  EXPECT_FALSE(json["joints"][1].contains("torque_constant"));
  const std::string text = DriveTrainsText(found);
  EXPECT_THAT(text, HasSubstr("not told: the joint does not move"));
}

// One direction of motion alone: dry friction is an offset there.
TEST(DriveTrains, OneDirectionTellsNoDryFriction) {
  std::mt19937_64 random(1);
  const Drives drives(&random);
  Log log = drives.Record(&random);
  log.q.col(0) = log.t + .1 * (3 * log.t.array()).sin().matrix();
  const Eigen::ArrayXd qd = 1 + .3 * (3 * log.t.array()).cos(),
                       qdd = -.9 * (3 * log.t.array()).sin();
  log.tau.col(0) = 20 * (log.q.col(0).array() * 2).sin();
  for (int k = 0; k < log.size(); ++k) {
    log.current(k, 0) = drives.Current(0, log.tau(k, 0), qd[k], qdd[k]);
  }
  AddNoise(&random, VectorXd::Constant(6, .01), &log.tau);
  const DriveTrain found = Estimate(drives.robot, log).joints[0];
  EXPECT_FALSE(found.told[DriveTrain::kCoulomb]);
  EXPECT_FALSE(found.told[DriveTrain::kOffset]);
  EXPECT_TRUE(found.told[DriveTrain::kTorqueConstant]);
  EXPECT_TRUE(found.stddev.allFinite());
  EXPECT_NEAR(found.value[DriveTrain::kTorqueConstant], drives.truth(0, 0),
              .02 * drives.truth(0, 0));
}

// Of a sensor whose noise is 8 % of the torque least squares' torque per ampere
// is .9 % too large in the mean, five deviations.
TEST(DriveTrains, NoiseOfTheSensorDrawsNothing) {
  double off = 0, squares = 0;
  for (int run = 0; run < 10; ++run) {
    std::mt19937_64 random(run);
    const Drives drives(&random);
    Log log = drives.Record(&random);
    AddNoise(&random, .08 * ColumnRms(log.tau), &log.tau);
    const DriveTrains found = Estimate(drives.robot, log);
    for (int j = 1; j < 3; ++j) {  // which carry most of the arm
      const DriveTrain& drive = found.joints[j];
      ASSERT_EQ(drive.not_told, "");
      const double K = drives.truth(j, DriveTrain::kTorqueConstant);
      off += drive.value[DriveTrain::kTorqueConstant] / K - 1;
      squares += std::pow(drive.stddev[DriveTrain::kTorqueConstant] / K, 2);
    }
  }
  EXPECT_LT(std::abs(off), 3 * std::sqrt(squares));
}

// A torque that goes with the joint's acceleration alone is told from the
// rotor's inertia by nothing.
TEST(DriveTrains, ALightLinkTellsNoTorqueConstant) {
  std::mt19937_64 random(1);
  const Drives drives(&random);
  Log log = drives.Record(&random);
  log.tau.col(5) = .4 * log.qdd.col(5);
  for (int k = 0; k < log.size(); ++k) {
    log.current(k, 5) =
        drives.Current(5, log.tau(k, 5), log.qd(k, 5), log.qdd(k, 5));
  }
  AddNoise(&random, .005 * ColumnRms(log.tau), &log.tau);
  AddNoise(&random, .005 * ColumnRms(log.current), &log.current);
  const DriveTrains found = Estimate(drives.robot, log);
  EXPECT_EQ(found.joints[4].not_told, "");
  EXPECT_THAT(found.joints[5].not_told, HasSubstr("joint's own motion"));
}

TEST(DriveTrains, LogsWithoutCurrentsHaveNone) {
  std::mt19937_64 random(1);
  const Drives drives(&random);
  Log log = drives.Record(&random);
  log.current.resize(0, 0);
  const DriveTrains found = Estimate(drives.robot, log);
  EXPECT_EQ(found.samples, 0);
  EXPECT_EQ(DriveTrainsText(found), "");
}

}  // namespace armcal::drive_train_test
