#include "calib/diagnose/data/swung_joints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/segments.h"
#include "tests/fixtures/swing.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::swung_joints_test {

constexpr double kMass = 2, kLength = .7, kGravity = 9.81;  // kg, m, m/s^2
constexpr double kStep = .004, kBandwidth = 10;             // s, Hz
constexpr int kSize = 3000;

// A point mass that hangs from a level axis.
Robot Pendulum() {
  Robot robot;
  Link link;
  link.name = "rod";
  link.X_PF.linear() =
      Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()).matrix();
  link.joint.name = "pivot";
  link.inertial = InertialParameters::FromCenterOfMass(
      kMass, Eigen::Vector3d(0, kLength, 0), Eigen::Matrix3d::Zero());
  robot.links.push_back(link);
  return robot;
}

// Let go at 60 degrees, q'' = -g / l sin q, by the midpoint rule. What is
// recorded of its drive is `share` of the weight's moment.
Log FreeSwing(double share) {
  Log log;
  log.t = Eigen::VectorXd::LinSpaced(kSize, 0, kStep * (kSize - 1));
  log.q.resize(kSize, 1);
  log.tau.resize(kSize, 1);
  const auto fall = [](double q) { return -kGravity / kLength * std::sin(q); };
  double q = M_PI / 3, qd = 0;
  for (int k = 0; k < kSize; ++k) {
    log.q(k, 0) = q;
    log.tau(k, 0) = share * kMass * kGravity * kLength * std::sin(q);
    const double middle = q + kStep / 2 * qd;
    q += kStep * (qd + kStep / 2 * fall(q));
    qd += kStep * fall(middle);
  }
  return log;
}

LogSet LogsOf(double share) {
  LogReaderOptions reader;
  reader.joint_names = {"pivot"};
  return LogSet({WriteFile(LogCsv(FreeSwing(share)), "swing.csv")}, reader, {});
}

// Gravity and inertia are as large as each other, sqrt(2) together.
TEST(SwungJoints, DrivesDoNextToNothingThere) {
  const auto find = [](double share) {
    return FindSwungJoints(Pendulum(),
                           ReadSegments(kBandwidth, {}, LogsOf(share)));
  };
  const std::vector<SwungJoint> swung = find(.04);
  ASSERT_EQ(swung.size(), 1u);
  EXPECT_EQ(swung[0].log, 0);
  EXPECT_EQ(swung[0].joint, 0);
  EXPECT_NEAR(swung[0].torque_rms / swung[0].needed_rms, .04 / std::sqrt(2.),
              1e-3);
  EXPECT_TRUE(find(.1).empty());
  // Nothing was recorded: another matter (GapSegments).
  EXPECT_TRUE(find(0).empty());
}

TEST(SwungJoints, OfAReferenceAreAskedNothing) {
  const LogSet logs = LogsOf(.04);
  std::vector<GapSegment> segments = ReadSegments(kBandwidth, {}, logs);
  EXPECT_FALSE(GapRows(segments, kBandwidth).runs(0).empty());
  EXPECT_TRUE(LeaveOutSwungJoints(Pendulum(), logs, &segments).empty());
  EXPECT_FALSE(GapRows(segments, kBandwidth).runs(0).empty());
  // Beside a log in which the drive works.
  segments = ReadSegments(kBandwidth, {}, logs);
  segments.push_back(ReadSegments(kBandwidth, {}, LogsOf(.5))[0]);
  segments.back().log = 1;
  const std::vector<DataFinding> findings =
      LeaveOutSwungJoints(Pendulum(), logs, &segments);
  EXPECT_TRUE(segments[0].still.all());
  EXPECT_FALSE(segments.back().still.all());
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_THAT(findings[0].finding, testing::HasSubstr("pivot"));
  EXPECT_THAT(findings[0].finding, testing::HasSubstr(logs.path(0)));
  EXPECT_TRUE(findings[0].is_doubt);
}

}  // namespace armcal::swung_joints_test
