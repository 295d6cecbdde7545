#include "calib/log_doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "calib/calibrate.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::log_doubts_test {

using testing::HasSubstr;
using testing::StartsWith;

class LogDoubtsTest : public testing::Test {
 protected:
  LogDoubtsTest() : arm_("3R elbow") {}

  CalibrateSummary Calibrated(const Log& log) const {
    return Calibrate(arm_.robot, {{LogSource("log.csv", log)}, {}}, options_);
  }
  static nlohmann::json WarningsOf(const CalibrateSummary& summary) {
    return nlohmann::json::parse(summary.json)["warnings"];
  }
  // It is the first thing that is said everywhere.
  static void ExpectFirst(const std::string& doubt,
                          const CalibrateSummary& summary) {
    EXPECT_THAT(summary.report, StartsWith("warning    of log.csv " + doubt));
    EXPECT_THAT(summary.brief, StartsWith("of log.csv " + doubt));
    const nlohmann::json warnings = WarningsOf(summary);
    ASSERT_FALSE(warnings.empty());
    EXPECT_THAT(std::string(warnings[0]), StartsWith("of log.csv " + doubt));
  }

  InspectedArm arm_;
  CalibrateOptions options_;
};

TEST_F(LogDoubtsTest, OfALogThatIsReadRightlyThereAreNone) {
  const CalibrateSummary summary = Calibrated(arm_.log);
  EXPECT_TRUE(summary.positive) << summary.report;
  EXPECT_THAT(summary.report, StartsWith("log        log.csv"));
  EXPECT_TRUE(WarningsOf(summary).empty());
}

// The linear fit leaves 1 %, with friction that gives power.
TEST_F(LogDoubtsTest, AllTorquesNegated) {
  arm_.log.tau *= -1;
  const CalibrateSummary summary = Calibrated(arm_.log);
  ExpectFirst("all torques have the wrong sign", summary);
  EXPECT_FALSE(summary.positive);
  const nlohmann::json verdict = nlohmann::json::parse(summary.json)["verdict"];
  EXPECT_FALSE(verdict["passed"]);
  EXPECT_THAT(std::string(verdict["reasons"][0]),
              StartsWith("no robot that can exist"));
  EXPECT_THAT(summary.report, HasSubstr("\nfailed     no robot that can"));
  options_.target = CalibrationTarget::kLinear;
  ExpectFirst("all torques have the wrong sign", Calibrated(arm_.log));
}

TEST_F(LogDoubtsTest, TimeInMilliseconds) {
  arm_.log.t *= 1000;
  ExpectFirst("the time is in ms", Calibrated(arm_.log));
  // Time alone is asked for its unit where a file has no masses.
  for (Link& link : arm_.robot.links) link.inertial = InertialParameters();
  ExpectFirst("the time is in ms", Calibrated(arm_.log));
}

TEST_F(LogDoubtsTest, Degrees) {
  arm_.log.q *= 180 / M_PI;
  arm_.log.qd.resize(0, 0);
  ExpectFirst("positions are in degrees", Calibrated(arm_.log));
}

// An arm of a thousand times the masses explains these as well.
TEST_F(LogDoubtsTest, TorquesInAnotherUnit) {
  arm_.log.tau *= 1000;
  const CalibrateSummary summary = Calibrated(arm_.log);
  ExpectFirst("the torques are in mN m", summary);
}

TEST_F(LogDoubtsTest, WhatIsHeldOutIsAskedToo) {
  Log other = arm_.log;
  other.q *= 180 / M_PI;
  other.qd.resize(0, 0);
  options_.validation.logs = {LogSource("held_out.csv", other)};
  EXPECT_THAT(
      Calibrated(arm_.log).report,
      StartsWith("warning    of held_out.csv positions are in degrees"));
}

TEST_F(LogDoubtsTest, AFileWithoutMassesTellsNothing) {
  for (Link& link : arm_.robot.links) link.inertial = InertialParameters();
  arm_.log.tau *= -1;
  for (const std::string warning : WarningsOf(Calibrated(arm_.log))) {
    // What the linear fit says of itself takes no file.
    EXPECT_THAT(warning, HasSubstr("below zero"));
  }
}

}  // namespace armcal::log_doubts_test
