#include "calib/inspect/stuck_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "calib/calibrate.h"
#include "calib/diagnose.h"
#include "calib/verify.h"
#include "model/log_files/log_reader.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::stuck_rows_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A recorder that writes zeros for joint 2 for half a second in motion, where
// its torque is large.
class StuckRows : public testing::Test {
 protected:
  StuckRows() : arm_("3R elbow") {
    arm_.log.qd.resize(0, 0);
    reading_.joint_names = arm_.robot.JointNames();
    log_ = arm_.log;
    Eigen::Index at = 0;
    log_.tau.col(1).segment(400, 1200).cwiseAbs().maxCoeff(&at);
    begin_ = static_cast<int>(at) + 375;
    log_.tau.col(1).segment(begin_, 50).setZero();
  }

  std::vector<DataFinding> LeaveOut(const Log& log, const TimeRange& crop) {
    return LeaveOutStuckRows(arm_.robot, {{LogSource("log.csv", log), crop}},
                             {}, &reading_);
  }
  DiagnoseSummary Diagnosis(const Log& log, const TimeRange& crop) const {
    DiagnoseOptions options;
    options.forward = false;
    options.reference.logs = {LogSource("reference.csv", arm_.log)};
    return Diagnose(arm_.robot, {{LogSource("log.csv", log)}, crop}, options);
  }

  InspectedArm arm_;
  Log log_;
  int begin_ = 0;
  LogReaderOptions reading_;
};

TEST_F(StuckRows, AreNotReadAnyMore) {
  const std::vector<DataFinding> told = LeaveOut(log_, {});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0].finding,
              AllOf(HasSubstr("log.csv"), HasSubstr("torque of joint2"),
                    HasSubstr("these rows are left out")));
  EXPECT_TRUE(told[0].leads);
  const std::vector<RowRange>& rows = reading_.left_out["log.csv"];
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].begin, begin_);
  EXPECT_EQ(rows[0].end, begin_ + 50);
}

TEST_F(StuckRows, AMotionHasNone) {
  EXPECT_TRUE(LeaveOut(arm_.log, {}).empty());
  EXPECT_TRUE(reading_.left_out.empty());
}

// What is outside of a crop is no part of the diagnosis.
TEST_F(StuckRows, OutsideOfACropAreNotTold) {
  const double end = log_.t[begin_] - .1;
  EXPECT_TRUE(LeaveOut(log_, {0, end}).empty());
}

// A log that is fitted up to a time, held out from there on, and a
// calibration's own as far as it goes.
TEST_F(StuckRows, OfALogThatIsUsedTwiceAreToldOnce) {
  const LogSource log("log.csv", log_);
  const double at = log_.t[begin_];
  const double end = log_.t[log_.size() - 1];
  const std::vector<UsedLog> parts = {
      {log, {0, at - 1}}, {log, {at - 1, end}}, {log, {0, end}}};
  EXPECT_EQ(LeaveOutStuckRows(arm_.robot, parts, {}, &reading_).size(), 1u);
  ASSERT_EQ(reading_.left_out["log.csv"].size(), 1u);
  EXPECT_EQ(reading_.left_out["log.csv"][0].begin, begin_);
}

// Half a second of zeros leads the diagnosis, which goes on: no touch, nor
// anything else, is made of it.
TEST_F(StuckRows, ADiagnosisGoesOnWithoutThem) {
  const DiagnoseSummary summary = Diagnosis(log_, {});
  EXPECT_THAT(summary.brief, AllOf(HasSubstr("the torque of joint2 is stuck"),
                                   HasSubstr("these rows are left out")));
  EXPECT_THAT(summary.json, HasSubstr("these rows are left out"));
  EXPECT_NE(summary.verdict, "not_testable");
  EXPECT_TRUE(summary.effects.empty());
}

// What is beside them is found all the same.
TEST_F(StuckRows, WhatChangedIsNamedBesideThem) {
  log_.tau.col(2) *= 1.5;
  log_.tau.col(1).segment(begin_, 50).setZero();
  const DiagnoseSummary summary = Diagnosis(log_, {});
  ASSERT_FALSE(summary.effects.empty());
  EXPECT_EQ(summary.effects[0].joint, "joint3");
  for (const DiagnosedEffect& effect : summary.effects) {
    EXPECT_THAT(effect.name, Not(HasSubstr("contact")));
  }
}

// Three seconds around them: what is left on both sides is too short.
TEST_F(StuckRows, WithTooLittleLeftNothingIsTestable) {
  const double at = log_.t[begin_];
  const TimeRange crop{at - 1.25, at + 1.75};
  EXPECT_TRUE(LeaveOut(log_, crop).empty());
  EXPECT_TRUE(reading_.left_out.empty());
  const DiagnoseSummary summary = Diagnosis(log_, crop);
  EXPECT_THAT(summary.brief, HasSubstr("the torque of joint2 is stuck at 0"));
  EXPECT_EQ(summary.verdict, "not_testable");
}

// From which on a joint goes far in 33 rows, without turning round.
int RowInMotion(const Log& log, int j) {
  int best = 300;
  const auto gone = [&](int k) {
    return std::abs(log.q(k + 33, j) - log.q(k, j));
  };
  for (int k = 300; k < 1700; ++k) best = gone(k) > gone(best) ? k : best;
  return best;
}

// What is read after MendPositions is as if the encoder were right.
class WrongPositions : public testing::Test {
 protected:
  WrongPositions() : arm_("3R elbow"), log_(arm_.log) {
    reading_.joint_names = arm_.robot.JointNames();
  }

  // Joint 1 wraps round, and so does its command.
  void Wrap() {
    log_.qref = log_.q;
    for (double& q : log_.q.col(0)) q = q > .1 ? q - 2 * M_PI : q;
    for (double& q : log_.qref.col(0)) q = q > .12 ? q - 2 * M_PI : q;
  }
  std::vector<DataFinding> Mend(const TimeRange& crop) {
    return MendPositions(arm_.robot, {{LogSource("log.csv", log_), crop}},
                         &reading_);
  }
  Log Read() {
    reading_.want_reference = true;
    return ReadWholeLog(LogSource("log.csv", log_), reading_);
  }
  // Of a column up to whole turns that it has from its first row on.
  static double Differs(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    const Eigen::VectorXd off = a - b;
    return (off.array() - off[0]).abs().maxCoeff();
  }
  CalibrateSummary Calibrated(const Log& log) const {
    return Calibrate(arm_.robot, {{LogSource("log.csv", log)}, {}}, {});
  }
  // A calibration that says it, and has inertias as good as of the right log.
  void ExpectCalibrates(const std::string& sentence) const {
    const CalibrateSummary right = Calibrated(arm_.log);
    const CalibrateSummary mended = Calibrated(log_);
    EXPECT_THAT(
        mended.report,
        StartsWith("warning    of log.csv the position of " + sentence));
    EXPECT_TRUE(mended.positive) << mended.report;
    ASSERT_EQ(mended.parameters.size(), right.parameters.size());
    for (size_t k = 0; k < right.parameters.size(); ++k) {
      const double off = mended.parameters[k].value - right.parameters[k].value;
      EXPECT_LT(std::abs(off), 4 * mended.parameters[k].stddev)
          << right.parameters[k].name;
    }
  }

  InspectedArm arm_;
  Log log_;
  LogReaderOptions reading_;
};

TEST_F(WrongPositions, OfARightLogThereAreNone) {
  EXPECT_TRUE(Mend({}).empty());
  EXPECT_TRUE(reading_.left_out.empty());
  EXPECT_TRUE(reading_.position_turns.empty());
}

TEST_F(WrongPositions, TurnsAreTakenOut) {
  Wrap();
  const std::vector<DataFinding> told = Mend({});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0].finding,
              AllOf(HasSubstr("of log.csv the position of joint1 wraps round"),
                    HasSubstr("these turns are taken out")));
  EXPECT_FALSE(told[0].leads);
  const Log read = Read();
  ASSERT_EQ(read.size(), log_.size());
  EXPECT_LT(Differs(read.q.col(0), arm_.log.q.col(0)), 1e-9);
  EXPECT_LT(Differs(read.qref.col(0), arm_.log.q.col(0)), 1e-9);
  log_.qref.resize(0, 0);
  ExpectCalibrates("joint1 wraps round");
}

// Which may begin in the middle of a turn.
TEST_F(WrongPositions, TurnsOutsideOfACropAreTakenOutAndNotTold) {
  Wrap();
  int row = 1;  // of the first turn
  while (std::abs(log_.q(row, 0) - log_.q(row - 1, 0)) < 1) ++row;
  const double first = log_.t[row - 1];
  EXPECT_TRUE(Mend({0, first - .1}).empty());
  EXPECT_LT(Differs(Read().q.col(0), arm_.log.q.col(0)), 1e-9);
}

// Whatever comes after it is not the arm's position, or what is before it.
TEST_F(WrongPositions, TheShorterSideOfALostZeroIsLeftOut) {
  log_.q.col(1).tail(800).array() += .3;
  const std::vector<DataFinding> told = Mend({});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0].finding,
              AllOf(HasSubstr("the position of joint2 jumps"),
                    HasSubstr("its shorter side are left out")));
  EXPECT_TRUE(told[0].leads);
  EXPECT_EQ(Read().size(), log_.size() - 800);
  ExpectCalibrates("joint2 jumps");
}

// A third of a second in motion, which no torque is asked about.
// Each side by itself is right.
TEST_F(WrongPositions, ACropOfOneZeroIsAsItWas) {
  log_.q.col(1).tail(600).array() += .4;
  const double at = log_.t[log_.size() - 600];
  for (const TimeRange& crop : {TimeRange{0, at - .1}, TimeRange{at, 1e9}}) {
    reading_.left_out.clear();
    EXPECT_TRUE(Mend(crop).empty()) << crop.begin;
    for (const RowRange& rows : reading_.left_out["log.csv"]) {
      const bool is_used =
          log_.t[rows.begin] < crop.end && log_.t[rows.end - 1] > crop.begin;
      EXPECT_FALSE(is_used) << crop.begin;
    }
  }
}

// A crop is in the log's own unit, as all readers have it.
TEST_F(WrongPositions, ACropOfALogInMillisecondsIsInThese) {
  log_.q.col(1).tail(800).array() += .3;
  const double at = 1e3 * log_.t[log_.size() - 800];
  log_.t *= 1e3;
  EXPECT_TRUE(Mend({0, at - 100}).empty());
  reading_.left_out.clear();
  EXPECT_EQ(Mend({at - 5000, at + 5000}).size(), 1u);
}

// Where too little would be left rows stay, and that is told.
TEST_F(WrongPositions, OfTooLittleNothingIsLeftOut) {
  log_.q.col(1).tail(800).array() += .3;
  const double at = log_.t[log_.size() - 800];
  const std::vector<DataFinding> told = Mend({at - 1.5, at + 1});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0].finding, HasSubstr("less than 2 s would be left"));
  EXPECT_TRUE(reading_.left_out.empty());
}

// Turns are taken out where the rest of the log is too short to leave out rows.
TEST_F(WrongPositions, TurnsOfAShortLogAreTakenOut) {
  Wrap();
  const int at = RowInMotion(arm_.log, 1);
  log_.q.col(1).segment(at, 33).setConstant(log_.q(at, 1));
  const double t = log_.t[at];
  LeaveOutStuckRows(arm_.robot, {{LogSource("log.csv", log_), {t, t + .34}}},
                    {}, &reading_);
  EXPECT_TRUE(reading_.left_out.empty());
  EXPECT_FALSE(reading_.position_turns["log.csv"].empty());
}

TEST_F(WrongPositions, RowsThatEndInAJumpAreLeftOut) {
  const int at = RowInMotion(arm_.log, 1);
  log_.q.col(1).segment(at, 33).setConstant(log_.q(at, 1));
  const std::vector<DataFinding> told = Mend({});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0].finding,
              AllOf(HasSubstr("the position of joint2 is stuck"),
                    HasSubstr("these rows are left out")));
  ASSERT_EQ(reading_.left_out["log.csv"].size(), 1u);
  EXPECT_EQ(reading_.left_out["log.csv"][0].begin, at);
  EXPECT_EQ(reading_.left_out["log.csv"][0].end, at + 33);
  ExpectCalibrates("joint2 is stuck");
}

// A diagnosis is of the same rows.
TEST_F(WrongPositions, ADiagnosisIsOfMendedPositions) {
  const auto brief_of = [&](const Log& log) {
    DiagnoseOptions options;
    options.forward = false;
    options.reference.logs = {LogSource("reference.csv", arm_.log)};
    const DiagnoseSummary summary =
        Diagnose(arm_.robot, {{LogSource("log.csv", log)}, {}}, options);
    EXPECT_TRUE(summary.effects.empty()) << summary.brief;
    EXPECT_NE(summary.verdict, "not_testable");
    return summary.report;
  };
  Log lost = log_;
  lost.q.col(1).tail(800).array() += .3;
  EXPECT_THAT(brief_of(lost), HasSubstr("the position of joint2 jumps"));
  Wrap();
  log_.qref.resize(0, 0);
  EXPECT_THAT(brief_of(log_), HasSubstr("the position of joint1 wraps round"));
}

TEST_F(WrongPositions, AVerificationIsOfMendedPositions) {
  Wrap();
  log_.qref.resize(0, 0);
  VerifyOptions options;
  options.budget_s = 1e-3;
  const VerifySummary summary =
      Verify(arm_.robot, {{LogSource("log.csv", log_)}, {}}, options);
  EXPECT_THAT(summary.report,
              StartsWith("warning    of log.csv the position of joint1 wraps"));
  EXPECT_THAT(summary.json, HasSubstr("these turns are taken out"));
}

}  // namespace armcal::stuck_rows_test
