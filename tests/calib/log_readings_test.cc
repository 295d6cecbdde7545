#include "calib/log_readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calib/diagnose.h"
#include "model/text/input_error.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::log_readings_test {

using testing::HasSubstr;
using testing::Not;

class LogReadingsTest : public testing::Test {
 protected:
  LogReadingsTest() : arm_("3R elbow") {
    options_.joint_names = arm_.robot.JointNames();
    degrees_ = milli_ = arm_.log;
    degrees_.q *= 180 / M_PI;
    milli_.tau *= 1000;
  }

  std::vector<DataFinding> Wrong(const Log& log, bool scales) const {
    return WrongReadings(arm_.robot, {LogSource("log.csv", log)}, options_,
                         scales);
  }
  DiagnoseSummary Diagnosis(const Log& log, const Log* reference) const {
    DiagnoseOptions options;
    options.forward = false;
    if (reference != nullptr) {
      options.reference.logs = {LogSource("reference.csv", *reference)};
    }
    return Diagnose(arm_.robot, {{LogSource("log.csv", log)}, {}}, options);
  }

  InspectedArm arm_;
  Log degrees_, milli_;
  LogReaderOptions options_;
};

TEST_F(LogReadingsTest, OfThisArmNothingIsWrong) {
  EXPECT_TRUE(Wrong(arm_.log, true).empty());
}

TEST_F(LogReadingsTest, UnitsAreOfAnotherArm) {
  const std::vector<DataFinding> wrong = Wrong(degrees_, true);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_THAT(wrong[0].finding, HasSubstr("degrees"));
  EXPECT_THAT(wrong[0].finding, HasSubstr("log.csv"));
  EXPECT_TRUE(wrong[0].leads);
}

// What is further off than a base is tilted.
TEST_F(LogReadingsTest, GravityThatIsTurnedIsOfAnotherArm) {
  const Eigen::Vector3d right = arm_.robot.gravity;
  arm_.robot.gravity = -right;
  const std::vector<DataFinding> wrong = Wrong(arm_.log, true);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_THAT(wrong[0].finding, HasSubstr("gravity points 180 degrees away"));
  arm_.robot.gravity = Eigen::AngleAxisd(.5, Eigen::Vector3d::UnitX()) * right;
  EXPECT_TRUE(Wrong(arm_.log, true).empty());
}

TEST_F(LogReadingsTest, AScaleMayBeTheReferencesToo) {
  EXPECT_EQ(Wrong(milli_, true).size(), 1u);
  EXPECT_TRUE(Wrong(milli_, false).empty());
}

// A doubt, which a diagnosis begins with and goes on.
TEST_F(LogReadingsTest, AZeroOfTheFileIsDoubted) {
  Log turned = arm_.log;
  turned.q.col(2).array() -= M_PI / 2;
  const std::vector<DataFinding> wrong = Wrong(turned, true);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_TRUE(wrong[0].is_doubt);
  EXPECT_THAT(wrong[0].finding, HasSubstr("joint3 has its zero 90"));
  EXPECT_TRUE(Wrong(turned, false).empty());
  const DiagnoseSummary summary = Diagnosis(turned, nullptr);
  EXPECT_THAT(summary.brief, HasSubstr("may be wrong in a joint"));
  EXPECT_NE(summary.verdict, "not_testable");
}

// Of one joint, of which a load may be several times what its link weighs.
TEST(LogReadings, ASingleJointsTorquesInAnotherUnitAreNoLoad) {
  const InspectedArm arm("2R planar (vertical plane)", 20, 1);
  LogReaderOptions options;
  options.joint_names = arm.robot.JointNames();
  const auto wrong = [&](double factor) {
    Log other = arm.log;
    other.tau *= factor;
    return WrongReadings(
        arm.robot, {LogSource("log.csv", other), LogSource("ref.csv", arm.log)},
        options, false);
  };
  EXPECT_TRUE(wrong(20).empty());
  const std::vector<DataFinding> milli = wrong(1000);
  ASSERT_EQ(milli.size(), 1u);
  EXPECT_THAT(milli[0].finding, HasSubstr("are not in one unit"));
}

// Which of the two it is, none tells.
TEST_F(LogReadingsTest, AReferenceInAnotherUnitIsTold) {
  for (const bool is_reference : {false, true}) {
    const DiagnoseSummary summary = is_reference ? Diagnosis(arm_.log, &milli_)
                                                 : Diagnosis(milli_, &arm_.log);
    EXPECT_EQ(summary.verdict, "not_testable");
    EXPECT_THAT(summary.brief, HasSubstr("are not in one unit"));
    EXPECT_THAT(summary.brief, HasSubstr("reference.csv"));
  }
  Log loaded = arm_.log;
  loaded.tau *= 2;
  EXPECT_THAT(Diagnosis(loaded, &arm_.log).brief, Not(HasSubstr("unit")));
}

// What a log and its reference differ in is the time, not a flag.
TEST_F(LogReadingsTest, TimeInAnotherUnitThanTheReferencesIsRefused) {
  Log slow = arm_.log;
  slow.t *= 1000;
  for (const bool is_reference : {false, true}) {
    try {
      is_reference ? Diagnosis(arm_.log, &slow) : Diagnosis(slow, &arm_.log);
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("the time is in ms, not in s"));
      EXPECT_THAT(error.what(), HasSubstr("a column t[ms]"));
      EXPECT_THAT(error.what(), Not(HasSubstr("bandwidth")));
    }
  }
}

// These rows of a log without velocities.
Log RowsOf(const Log& log, const std::vector<int>& rows) {
  Log some;
  some.t = log.t(rows);
  some.q = log.q(rows, Eigen::all);
  some.tau = log.tau(rows, Eigen::all);
  return some;
}

// `count` of them, each `stride`-th.
std::vector<int> EachRow(int stride, int count) {
  std::vector<int> rows(count);
  for (int k = 0; k < count; ++k) rows[k] = stride * k;
  return rows;
}

// Its bandwidth is a thousandth of what it would be, which leaves no motion.
TEST_F(LogReadingsTest, ALogByItselfWhoseTimeIsInMilliseconds) {
  Log slow = RowsOf(arm_.log, EachRow(1, 80));
  slow.t *= 1000;
  try {
    Diagnosis(slow, nullptr);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the time is in ms, not in s"));
    EXPECT_THAT(error.what(), Not(HasSubstr("bandwidth")));
  }
}

// A log of 20 Hz leaves 2.5 Hz to itself and to its reference, whose 4 s would
// do at 10 Hz.
TEST_F(LogReadingsTest, TheLogThatLeavesTooLittleBandwidthIsNamed) {
  const Log slow =
      RowsOf(arm_.log, EachRow(5, static_cast<int>(arm_.log.size()) / 5));
  const Log reference = RowsOf(arm_.log, EachRow(1, 400));
  try {
    Diagnosis(slow, &reference);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("log.csv: no motion is left of reference.csv at the "
                          "2.5 Hz that this log's rate allows"));
  }
}

// Two rows of 29 are lost: 20 s of motion, and no 2 s without a gap.
TEST_F(LogReadingsTest, GapsAreNamedWhereTheyLeaveNothing) {
  std::vector<int> rows;
  for (int k = 0; k < arm_.log.size(); ++k) {
    if (k % 29 > 1) rows.push_back(k);
  }
  Log log;
  log.t = arm_.log.t(rows);
  for (int k = 0; k + 1 < log.size(); ++k) {
    if (rows[k + 1] - rows[k] > 1) log.t[k] -= 5e-4;  // 30.5 ms
  }
  log.q = arm_.log.q(rows, Eigen::all);
  log.tau = arm_.log.tau(rows, Eigen::all);
  try {
    Diagnosis(log, nullptr);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no motion is left of it between its"));
    EXPECT_THAT(error.what(), HasSubstr("`bandwidth`=8, for which these gaps"));
  }
}

// Rows that are left out as stuck were told when they were.
TEST_F(LogReadingsTest, WhatIsLeftOutIsNotToldAgain) {
  Log log = arm_.log;
  log.qd.resize(0, 0);
  Eigen::Index at = 0;
  log.tau.col(1).segment(200, 1500).cwiseAbs().maxCoeff(&at);
  log.tau.col(1).segment(at + 175, 50).setZero();
  const std::vector<DataFinding> wrong = Wrong(log, true);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_THAT(wrong[0].finding,
              HasSubstr("the torque of joint2 is stuck at 0"));
  options_.left_out["log.csv"] = {{at + 175, at + 225}};
  EXPECT_TRUE(Wrong(log, true).empty());
}

// Degrees would be friction and a clock of another rate.
TEST_F(LogReadingsTest, NothingIsToldOfAnotherArm) {
  const DiagnoseSummary summary = Diagnosis(degrees_, nullptr);
  EXPECT_THAT(summary.brief, HasSubstr("degrees"));
  EXPECT_EQ(summary.verdict, "not_testable");
  EXPECT_FALSE(summary.positive);
  EXPECT_TRUE(summary.effects.empty());
}

TEST_F(LogReadingsTest, AReferenceOfAnotherArmTellsNothing) {
  EXPECT_EQ(Diagnosis(arm_.log, &degrees_).verdict, "not_testable");
  EXPECT_NE(Diagnosis(milli_, &milli_).verdict, "not_testable");
}

}  // namespace armcal::log_readings_test
