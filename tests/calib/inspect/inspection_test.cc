#include "calib/inspect/inspection.h"

#include <gtest/gtest.h>

#include "calib/inspect/inspection_report.h"
#include "model/log_files/log_reader.h"
#include "model/log_files/log_writer.h"
#include "model/text/input_error.h"
#include "tests/fixtures/inspected_arm.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::inspection_test {

using testing::Test;

class InspectionTest : public Test {
 protected:
  InspectionTest() : arm_("3R elbow") {
    options_.joint_names = arm_.robot.JointNames();
  }

  LogInspection Inspect(const Log& log) {
    path_ = WriteFile(LogCsv(log), "inspected.csv");
    return InspectLog(arm_.robot, path_, options_);
  }

  InspectedArm arm_;
  LogReaderOptions options_;
  std::string path_;
};

TEST_F(InspectionTest, ACleanLogIsClean) {
  const LogInspection inspection = Inspect(arm_.log);
  EXPECT_TRUE(inspection.findings.empty());
  EXPECT_TRUE(inspection.as_it_is);
  EXPECT_LT(inspection.residual_percent, 5);
  const LogCoverage coverage = CoverageOf(arm_.robot, path_, options_);
  EXPECT_TRUE(coverage.known) << coverage.reason;
  EXPECT_EQ(coverage.rank, coverage.total);
  EXPECT_TRUE(coverage.findings.empty());
}

// Of links that weigh, and a torque in another unit.
TEST_F(InspectionTest, AJointWithNextToNoTorqueIsTold) {
  const auto unpowered = [this](double share) {
    Log log = arm_.log;
    log.tau.col(1) *= share;
    return CoverageOf(arm_.robot, WriteFile(LogText(log), "weak.csv"), options_)
        .unpowered;
  };
  EXPECT_TRUE(unpowered(1).empty());
  ASSERT_EQ(unpowered(.003).size(), 1u);
  EXPECT_EQ(unpowered(.003)[0].joint, 1);
}

TEST_F(InspectionTest, ALogOfNoTimeIsRefused) {
  Log log = arm_.log;
  log.t.setConstant(1.7e9);
  EXPECT_THROW(Inspect(log), InputError);
}

// A spike of 1 rad in one row used to be told as columns that are exchanged; it
// is told as it is, and what is written has none.
TEST_F(InspectionTest, ASpikeIsToldAndTakenOut) {
  Log wrong = arm_.log;
  wrong.q(500, 1) += 1;
  const LogInspection inspection = Inspect(wrong);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "position_spike");
  EXPECT_EQ(inspection.findings[0].joint, 1);
  const Log mended = Mended(arm_.robot, wrong, inspection);
  EXPECT_NEAR(mended.q(500, 1), arm_.log.q(500, 1), .01);
}

// Its velocity, which is right, says that it is the position, and stays.
TEST_F(InspectionTest, AVelocityTellsWhoseSignIsWrong) {
  Log wrong = arm_.log;
  wrong.q.col(1) *= -1;
  const LogInspection inspection = InspectLog(
      arm_.robot, WriteFile(LogText(wrong), "velocity.csv"), options_);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "position_sign");
  const Log mended = Mended(arm_.robot, wrong, inspection);
  EXPECT_EQ(mended.q, arm_.log.q);
  EXPECT_EQ(mended.qd, arm_.log.qd);
}

// A wrong zero from one row on would be explained by any reading.
TEST_F(InspectionTest, NothingIsAskedOfPositionsThatJump) {
  Log wrong = arm_.log;
  wrong.q.col(1).tail(900).array() += .4;
  const LogInspection inspection = Inspect(wrong);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "position_jump");
  EXPECT_EQ(inspection.residual_percent, 0);
  EXPECT_NE(inspection.coverage.reason, "");
}

// A torque that has nothing to do with the motion, however columns are read.
TEST_F(InspectionTest, ATorqueThatNoReadingExplainsIsSaid) {
  Log wrong = arm_.log;
  std::mt19937_64 random(1);
  const Eigen::VectorXd rms = ColumnRms(wrong.tau);
  wrong.tau.setZero();
  AddNoise(&random, rms, &wrong.tau);
  const auto said = [&](const Log& log) {
    return FullReport(arm_.robot, {}, {Inspect(log)});
  };
  const std::string but = "nothing wrong was found, but no reading makes";
  EXPECT_NE(said(wrong).find(but), std::string::npos) << said(wrong);
  EXPECT_EQ(said(arm_.log).find(but), std::string::npos);
}

// Most of it is turned round, too, but no sign that is turned back mends it.
TEST_F(InspectionTest, WhatHasNoSignHasNoWrongOne) {
  Log wrong = arm_.log;
  const double rms = ColumnRms(wrong.tau)[0];
  wrong.tau.col(0) = (wrong.tau.col(0).array() - rms).abs().eval();
  const LogInspection inspection = Inspect(wrong);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "unsigned_torque");
  EXPECT_EQ(Mended(arm_.robot, wrong, inspection).tau, wrong.tau);
}

TEST_F(InspectionTest, AWrongSignIsNamedAndMended) {
  Log wrong = arm_.log;
  wrong.tau.col(1) *= -1;
  const LogInspection inspection = Inspect(wrong);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "torque_sign");
  EXPECT_EQ(inspection.findings[0].joint, 1);
  EXPECT_FALSE(inspection.as_it_is);
  const Log mended = Mended(arm_.robot, wrong, inspection);
  EXPECT_LT((mended.tau - arm_.log.tau).cwiseAbs().maxCoeff(), 1e-12);
  const std::string text = FullReport(arm_.robot, {}, {inspection});
  EXPECT_NE(text.find("the torque of joint2 has the wrong sign"),
            std::string::npos)
      << text;
  const nlohmann::json json = ToJson(arm_.robot, {}, {inspection});
  EXPECT_EQ(json["logs"][0]["findings"][0]["joint_index"], 2);
  EXPECT_EQ(json["logs"][0]["coverage"]["known"], false);
}

TEST_F(InspectionTest, ExchangedPositionsAreNamedAndMended) {
  Log wrong = arm_.log;
  wrong.q.col(1).swap(wrong.q.col(2));
  wrong.qd.col(1).swap(wrong.qd.col(2));
  const LogInspection inspection = Inspect(wrong);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "position_order");
  EXPECT_EQ(inspection.findings[0].sentence,
            "the positions of joint2 and joint3 are exchanged");
  const Log mended = Mended(arm_.robot, wrong, inspection);
  EXPECT_EQ(mended.q, arm_.log.q);
  EXPECT_EQ(mended.qd, arm_.log.qd);
  EXPECT_EQ(mended.tau, arm_.log.tau);
}

TEST_F(InspectionTest, TimeInMillisecondsIsNamed) {
  Log wrong = arm_.log;
  wrong.t *= 1000;
  const LogInspection inspection = Inspect(wrong);
  ASSERT_FALSE(inspection.findings.empty());
  EXPECT_EQ(inspection.findings[0].finding, "time_unit");
  EXPECT_NEAR(inspection.duration, 20, .1);
}

// Velocities in rad/s beside positions in degrees: one finding, the cause.
TEST_F(InspectionTest, DegreesAreTheOnlyFinding) {
  Log wrong = arm_.log;
  ASSERT_GT(wrong.qd.size(), 0);
  wrong.q *= 180 / M_PI;
  path_ = WriteFile(LogText(wrong), "degrees.csv");
  const LogInspection inspection = InspectLog(arm_.robot, path_, options_);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "position_unit");
  const double travel =
      arm_.log.q.col(1).maxCoeff() - arm_.log.q.col(1).minCoeff();
  EXPECT_NEAR(inspection.travel[1], travel, 1e-3 * travel);
  const Log mended = Mended(arm_.robot, wrong, inspection);
  EXPECT_LT((mended.q - arm_.log.q).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(mended.qd, wrong.qd);
  // One velocity that is wrong beside is told after the cause.
  wrong.qd.col(2) *= 3;
  path_ = WriteFile(LogText(wrong), "degrees.csv");
  const LogInspection two = InspectLog(arm_.robot, path_, options_);
  ASSERT_EQ(two.findings.size(), 2u);
  EXPECT_EQ(two.findings[0].finding, "position_unit");
  EXPECT_EQ(two.findings[1].finding, "velocity");
  EXPECT_EQ(two.findings[1].joint, 2);
}

// A tenth of a second of one joint's torque, every other second, is off.
TEST_F(InspectionTest, GrossErrorsAreNamedWithTheirJoint) {
  Log wrong = arm_.log;
  const double size = 20 * ColumnRms(wrong.tau)[2];
  for (int s = 100; s < wrong.size(); s += 40) wrong.tau(s, 2) += size;
  const LogInspection inspection = Inspect(wrong);
  const LogCoverage coverage = CoverageOf(arm_.robot, path_, options_);
  ASSERT_TRUE(coverage.known) << coverage.reason;
  ASSERT_EQ(coverage.findings.size(), 1u);
  EXPECT_EQ(coverage.findings[0].finding, "outliers");
  EXPECT_EQ(coverage.findings[0].joint, 2);
  // Of all that calibrate leaves out.
  const std::string all = std::to_string(coverage.outliers[2]) + " stick out";
  EXPECT_NE(coverage.findings[0].evidence.find(all), std::string::npos);
}

// A model whose friction turns over a little too early or late leaves the same.
TEST_F(InspectionTest, WhatIsOffAtReversalsIsNoGrossError) {
  Log wrong = arm_.log;
  const double size = 20 * ColumnRms(wrong.tau)[2];
  int reversals = 0;
  for (int s = 1; s < wrong.size(); ++s) {
    if (wrong.q(s, 2) == wrong.q(s - 1, 2)) continue;
    if (s < 2 || (wrong.q(s, 2) - wrong.q(s - 1, 2)) *
                         (wrong.q(s - 1, 2) - wrong.q(s - 2, 2)) >=
                     0) {
      continue;
    }
    wrong.tau(s, 2) += size;
    ++reversals;
  }
  ASSERT_GE(reversals, .005 * wrong.size());
  Inspect(wrong);
  const LogCoverage coverage = CoverageOf(arm_.robot, path_, options_);
  ASSERT_TRUE(coverage.known) << coverage.reason;
  EXPECT_GE(coverage.outliers[2], .005 * wrong.size());
  for (const InspectionFinding& finding : coverage.findings) {
    EXPECT_NE(finding.finding, "outliers");
  }
}

TEST_F(InspectionTest, AJointAtRestIsMissed) {
  Log still = RecordMotion(
      [] {
        std::mt19937_64 random(2);
        Multisine motion = RandomMultisine(&random, 3);
        motion.amplitude.row(2).setZero();
        return motion;
      }(),
      20, .01);
  AddTorque(arm_.robot, &still);
  std::mt19937_64 random(4);
  AddNoise(&random, .01 * ColumnRms(still.tau), &still.tau);
  Inspect(still);
  const LogCoverage coverage = CoverageOf(arm_.robot, path_, options_);
  ASSERT_TRUE(coverage.known) << coverage.reason;
  EXPECT_LT(coverage.rank, coverage.total);
  EXPECT_EQ(coverage.unseen.size(),
            static_cast<size_t>(coverage.total - coverage.rank));
  EXPECT_NE(coverage.advice.find("joint3"), std::string::npos)
      << coverage.advice;
}

// A log of commands and positions: what can be told without a torque.
TEST_F(InspectionTest, CommandsAloneAreDescribed) {
  Log commanded = arm_.log;
  commanded.tau.resize(0, 0);
  commanded.qd.resize(0, 0);
  commanded.qref = commanded.q.array() + .01;
  path_ = WriteFile(LogText(commanded), "commanded.csv");
  const LogInspection inspection = InspectLog(arm_.robot, path_, options_);
  EXPECT_TRUE(inspection.findings.empty());
  EXPECT_TRUE(inspection.torque_source.empty());
  EXPECT_NEAR(inspection.tracking_rms[1], .01, 1e-9);
  EXPECT_GT(inspection.top_speed[1], 0);
  EXPECT_FALSE(inspection.as_it_is);
  const auto text = FullReport(arm_.robot, {}, {inspection});
  EXPECT_NE(text.find("torque: none; commands (qref)"), std::string::npos);
  EXPECT_NE(text.find("0.01 rad rms off its command"), std::string::npos);
  // Time in ms is mended without a torque, too.
  commanded.t *= 1000;
  path_ = WriteFile(LogText(commanded), "commanded.csv");
  const LogInspection slow = InspectLog(arm_.robot, path_, options_);
  ASSERT_EQ(slow.findings.size(), 1u);
  EXPECT_EQ(slow.findings[0].finding, "time_unit");
  const Log mended = Mended(arm_.robot, commanded, slow);
  EXPECT_NEAR(mended.t[100], arm_.log.t[100], 1e-9);
  EXPECT_EQ(mended.qref, commanded.qref);
}

// Of currents without constants the columns and what to give are named; the
// motion is told as of any log.
TEST_F(InspectionTest, CurrentsWithoutConstantsAreNamed) {
  Log log = arm_.log;
  log.qd.resize(0, 0);
  path_ = WriteFile(LogText(log, {{2, 2, 2}}), "currents.csv");
  const LogInspection inspection = InspectLog(arm_.robot, path_, options_);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "unscaled_currents");
  EXPECT_NE(inspection.findings[0].evidence.find("columns i1 to i3"),
            std::string::npos);
  EXPECT_EQ(inspection.findings[0].remedy.find("`torque_constants`=K1,.."), 0u);
  EXPECT_GT(inspection.top_speed[1], 0);
  const auto text = FullReport(arm_.robot, {}, {inspection});
  EXPECT_NE(text.find("torque: none; currents (i1 to i3) that need "
                      "`torque_constants`\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("rms off its command"), std::string::npos);
  // With constants they are torques.
  options_.torque_constants = {2, 2, 2};
  EXPECT_TRUE(InspectLog(arm_.robot, path_, options_).findings.empty());
}

// Every sample is in a bin, with gaps where stamps have them.
TEST_F(InspectionTest, DrawsWhatIsLogged) {
  Log log = arm_.log;
  log.t.tail(log.size() / 2).array() += 3;
  path_ = WriteFile(LogText(log), "drawn.csv");
  const LogDrawing drawing =
      InspectLog(arm_.robot, path_, options_, 50).drawing;
  ASSERT_TRUE(drawing.position && drawing.torque);
  EXPECT_FALSE(drawing.commanded);
  long samples = 0;
  int breaks = 0;
  double most = -1e300;
  for (const SeriesEnvelope::Bin& bin : drawing.torque->bins()) {
    samples += bin.samples;
    breaks += !bin.follows;
    most = std::max(most, bin.high[1]);
  }
  EXPECT_EQ(samples, log.size());
  EXPECT_EQ(breaks, 2);  // the first bin follows none
  EXPECT_NEAR(most, log.tau.col(1).maxCoeff(), 1e-6);
  EXPECT_FALSE(InspectLog(arm_.robot, path_, options_).drawing.position);
}

}  // namespace armcal::inspection_test
