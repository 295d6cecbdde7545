#include "calib/inspect/stuck_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "calib/diagnose.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::stuck_rows_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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

}  // namespace armcal::stuck_rows_test
