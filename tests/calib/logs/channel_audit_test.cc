#include "calib/logs/channel_audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::channel_audit_test {

using testing::ElementsAre;
using testing::IsEmpty;

class ChannelAuditTest : public testing::Test {
 protected:
  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const InspectionFinding& finding :
         AuditChannels(arm_.robot, arm_.log, AuditStamps(arm_.log))) {
      names.push_back(finding.finding);
    }
    return names;
  }
  void Keep(const std::vector<int>& rows) {
    Log& log = arm_.log;
    log.t = Eigen::VectorXd(log.t(rows));
    for (Eigen::MatrixXd* x : {&log.q, &log.qd, &log.qdd, &log.tau}) {
      *x = Eigen::MatrixXd((*x)(rows, Eigen::all));
    }
  }

  InspectedArm arm_{"2R planar (vertical plane)", 10};
};

TEST_F(ChannelAuditTest, NothingIsWrong) {
  EXPECT_THAT(Names(), IsEmpty());
  const StampFigures stamps = AuditStamps(arm_.log);
  EXPECT_NEAR(stamps.step, .01, 1e-9);
  EXPECT_EQ(stamps.unit, 1);
  EXPECT_EQ(stamps.lost_share, 0);
}

TEST_F(ChannelAuditTest, TimeInOtherUnits) {
  for (const double factor : {1e3, 1e6, 1e9}) {
    InspectedArm arm("2R planar (vertical plane)", 10);
    arm.log.t *= factor;
    const StampFigures stamps = AuditStamps(arm.log);
    EXPECT_DOUBLE_EQ(stamps.unit, 1 / factor);
    EXPECT_NEAR(stamps.step, .01, 1e-9);
  }
  Log log = arm_.log;
  log.t *= 1e3;
  const auto findings = AuditChannels(arm_.robot, arm_.log, AuditStamps(log));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].finding, "time_unit");
}

// A column 0, 1, 2, .. is a counter where recorded velocities say that a row is
// 10 ms, in ms where they say 1 ms, and may be either where there are none.
TEST_F(ChannelAuditTest, RowNumbersAreNoMilliseconds) {
  Log log = arm_.log;
  log.t.setLinSpaced(log.size(), 0, log.size() - 1);
  const auto said = [&] {
    return AuditChannels(arm_.robot, arm_.log, AuditStamps(log))[0];
  };
  EXPECT_NEAR(AuditStamps(log).unit, .01, 1e-4);
  EXPECT_EQ(said().finding, "row_counter");
  EXPECT_EQ(said().sentence, "the time counts rows");
  Log fast = log;
  fast.qd *= 10;
  EXPECT_EQ(AuditStamps(fast).unit, 1e-3);
  EXPECT_FALSE(AuditStamps(fast).counts_rows);
  log.qd.resize(0, 0);
  EXPECT_EQ(said().finding, "row_counter");
  EXPECT_EQ(said().sentence, "the time counts rows, or is in ms at 1 kHz");
  log.t[5] += .5;
  EXPECT_FALSE(AuditStamps(log).counts_rows);
}

TEST_F(ChannelAuditTest, StampsThatRepeatAreCoarse) {
  for (double& t : arm_.log.t) t = std::floor(t / .05) * .05;
  const auto findings =
      AuditChannels(arm_.robot, arm_.log, AuditStamps(arm_.log));
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].finding, "coarse_stamps");
  EXPECT_EQ(findings[0].evidence, "80 % of the rows, which are dropped");
}

// Rows of one time are dropped, which is said where they are as long as a hole.
TEST_F(ChannelAuditTest, AClockThatStopsIsSaid) {
  arm_.log.t.segment(301, 2).setConstant(arm_.log.t[300]);
  EXPECT_THAT(Names(), IsEmpty());  // three rows could be a burst of messages
  arm_.log.t.segment(301, 40).setConstant(arm_.log.t[300]);
  const auto findings =
      AuditChannels(arm_.robot, arm_.log, AuditStamps(arm_.log));
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].finding, "stopped_clock");
  EXPECT_EQ(findings[0].evidence,
            "40 rows after that at 3 s have its time, and are dropped");
  EXPECT_EQ(findings[1].finding, "holes");
}

TEST_F(ChannelAuditTest, AVelocityOfZeroIsNone) {
  arm_.log.qd.col(1).setZero();
  EXPECT_THAT(Names(), ElementsAre("velocity"));
}

// All by one factor are one finding, and what it may be; others stay.
TEST_F(ChannelAuditTest, OneFactorOfAllVelocities) {
  const auto said = [&](double first, double second) {
    Log log = arm_.log;
    log.qd.col(0) *= first;
    log.qd.col(1) *= second;
    auto findings = AuditChannels(arm_.robot, log, AuditStamps(log));
    SayOfAllVelocities(arm_.robot, log, &findings);
    return findings;
  };
  auto findings = said(2, 2);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].joint, -1);
  EXPECT_NE(findings[0].remedy.find("times too long"), std::string::npos);
  findings = said(180 / M_PI, 180 / M_PI);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].remedy, "they may be in deg/s");
  EXPECT_EQ(said(2, 3).size(), 2u);
  EXPECT_EQ(said(1, 2).size(), 1u);
  EXPECT_EQ(said(1, 2)[0].joint, 1);
}

TEST_F(ChannelAuditTest, EveryThirdSampleIsLost) {
  std::vector<int> rows;
  for (int k = 0; k < arm_.log.size(); ++k) {
    if (k % 3 != 0) rows.push_back(k);
  }
  Keep(rows);
  EXPECT_THAT(Names(), ElementsAre("lost_samples"));
  EXPECT_NEAR(AuditStamps(arm_.log).lost_share, 1. / 3, .01);
}

// Steps that vary are no losses.
TEST_F(ChannelAuditTest, JitterIsNoLoss) {
  std::mt19937_64 random(1);
  for (int k = 1; k + 1 < arm_.log.size(); ++k) {
    arm_.log.t[k] += Uniform(&random, -.001, .001);
  }
  EXPECT_THAT(Names(), IsEmpty());
}

// Jitter of a third of a step makes steps of .4 to 1.6 of it, and no row is
// lost; losses beside a jitter of a tenth are seen.
TEST_F(ChannelAuditTest, LargeJitterIsNoLoss) {
  const Eigen::VectorXd t = arm_.log.t;
  const auto jitter = [&](double most) {
    std::mt19937_64 random(1);
    for (int k = 1; k + 1 < arm_.log.size(); ++k) {
      arm_.log.t[k] += Uniform(&random, -most, most);
    }
  };
  for (const double most : {.003, .0045}) {
    arm_.log.t = t;
    jitter(most);
    EXPECT_EQ(AuditStamps(arm_.log).lost_share, 0);
  }
  arm_.log.t = t;
  std::vector<int> rows;
  for (int k = 0; k < arm_.log.size(); ++k) {
    if (k % 3 != 0) rows.push_back(k);
  }
  Keep(rows);
  const Eigen::VectorXd kept = arm_.log.t;
  for (const double most : {.0005, .001}) {
    arm_.log.t = kept;
    jitter(most);
    EXPECT_NEAR(AuditStamps(arm_.log).lost_share, 1. / 3, .02) << most;
  }
}

TEST_F(ChannelAuditTest, StuckColumns) {
  arm_.log.tau.col(1).segment(300, 250).setConstant(arm_.log.tau(300, 1));
  EXPECT_THAT(Names(), ElementsAre("stuck"));
}

TEST_F(ChannelAuditTest, StuckPosition) {
  arm_.log.q.col(0).setConstant(.3);
  const auto names = Names();
  EXPECT_THAT(names, testing::Contains("stuck"));
}

TEST_F(ChannelAuditTest, VelocityOfOtherSignOrUnit) {
  arm_.log.qd.col(0) *= -1;
  EXPECT_THAT(Names(), ElementsAre("velocity"));
  arm_.log.qd.col(0) *= -180 / M_PI;
  EXPECT_THAT(Names(), ElementsAre("velocity"));
}

TEST_F(ChannelAuditTest, TorqueAtItsLimit) {
  const double limit = .7 * arm_.log.tau.col(0).maxCoeff();
  arm_.log.tau.col(0) = arm_.log.tau.col(0).cwiseMin(limit).eval();
  EXPECT_THAT(Names(), ElementsAre("saturated"));
}

// A drive that is off half of the time and pushes one way.
TEST_F(ChannelAuditTest, NothingIsCutOffAtZero) {
  const Eigen::VectorXd tau = arm_.log.tau.col(0);
  arm_.log.tau.col(0) = (tau.array() - tau.mean()).max(0);
  EXPECT_THAT(Names(), IsEmpty());
}

// The step is that between the rows that are there.
TEST_F(ChannelAuditTest, HolesLeaveTheStep) {
  std::vector<int> rows;
  for (int k = 0; k < arm_.log.size(); ++k) {
    if (k % 100 < 70) rows.push_back(k);
  }
  Keep(rows);
  const StampFigures stamps = AuditStamps(arm_.log);
  EXPECT_EQ(stamps.holes, 10);
  EXPECT_NEAR(stamps.mean_step, .01, 1e-9);
}

TEST_F(ChannelAuditTest, CoarseTorque) {
  const double step = arm_.log.tau.col(0).cwiseAbs().maxCoeff() / 15;
  arm_.log.tau.col(0) = step * (arm_.log.tau.col(0) / step).array().round();
  EXPECT_THAT(Names(), testing::Contains("quantised"));
}

// Digits help where the log was rounded when it was written, in its own unit.
TEST_F(ChannelAuditTest, OnlyARoundedTorqueWantsDigits) {
  const Eigen::VectorXd tau = arm_.log.tau.col(0);
  const double most = tau.cwiseAbs().maxCoeff();
  const auto remedy = [&](double step, const std::vector<double>& units) {
    arm_.log.tau.col(0) =
        step * (10 * tau / most).array().round();  // 21 values
    for (const auto& f :
         AuditChannels(arm_.robot, arm_.log, AuditStamps(arm_.log), units)) {
      if (f.finding == "quantised") return f.remedy;
    }
    return std::string();
  };
  EXPECT_EQ(remedy(.1, {}), "log more digits");
  EXPECT_EQ(remedy(.01 * 2.409, {2.409, 2.409}), "log more digits");
  // A servo that counts its current by 2.69 mA.
  EXPECT_THAT(remedy(.00269 * 2.409, {2.409, 2.409}),
              testing::StartsWith("all are whole numbers of 0.00648 N m, the "
                                  "resolution of what measures it"));
}

}  // namespace armcal::channel_audit_test
