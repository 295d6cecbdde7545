#include "calib/watch/watcher.h"

#include <gmock/gmock.h>

#include <Eigen/QR>

#include "tests/calib/watch/watched_arm.h"

namespace armcal::watcher_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::IsEmpty;
using Kind = WatchEvent::Kind;

constexpr double kLearn = 15;

struct Watched {
  explicit Watched(const Robot& calibrated)
      : watcher(WatchedModel(calibrated), Options(),
                [this](const WatchEvent& event) { events.push_back(event); }) {}
  static WatcherOptions Options() {
    WatcherOptions options;
    options.learn_s = kLearn;
    return options;
  }
  void Add(const Log& log, double begin = 0) {
    for (int k = 0; k < log.size(); ++k) {
      watcher.Add(begin + log.t[k], log.q.row(k), log.tau.row(k));
    }
  }
  std::vector<WatchEvent> Changes() const {
    std::vector<WatchEvent> changes;
    for (const WatchEvent& event : events) {
      if (IsChange(event.kind)) changes.push_back(event);
    }
    return changes;
  }
  std::vector<WatchEvent> events;
  Watcher watcher;
};

// One motion; from `change` on the torque of another robot.
Log Changing(const Robot& before, const Robot& after, double change) {
  Log log = WatchedLog(before, 5, 30);
  const Log other = WatchedLog(after, 5, 30);
  for (int k = 0; k < log.size(); ++k) {
    if (log.t[k] >= change) log.tau.row(k) = other.tau.row(k);
  }
  return log;
}

Robot WithPayload(Robot robot, double mass) {
  robot.links.back().inertial += InertialParameters::FromCenterOfMass(
      mass, {.02, .03, -.01}, mass * .001 * Eigen::Matrix3d::Identity());
  return robot;
}

TEST(Watcher, NothingIsToldWhereNothingChanges) {
  const Robot robot = WatchedRobot();
  Watched watched(robot);
  watched.Add(WatchedLog(robot, 4, 60));
  EXPECT_THAT(watched.Changes(), IsEmpty());
  ASSERT_EQ(watched.events.size(), 1);
  EXPECT_EQ(watched.events[0].kind, Kind::kLearned);
}

TEST(Watcher, APayloadIsToldWithinTwoSeconds) {
  const Robot robot = WatchedRobot();
  Watched watched(robot);
  watched.Add(Changing(robot, WithPayload(robot, .3), 20));
  const auto changes = watched.Changes();
  ASSERT_FALSE(changes.empty());
  const WatchEvent& told = changes.back();
  EXPECT_EQ(told.kind, Kind::kPayload);
  EXPECT_LT(told.time, 22);
  EXPECT_NEAR(told.values[0].value, .3, 4 * told.values[0].stddev);
  // It is known better and better as it lasts.
  const WatchedValue now = watched.watcher.State().changes[0];
  EXPECT_NEAR(now.value, .3, 4 * now.stddev);
  EXPECT_LT(now.stddev, told.values[0].stddev);
}

TEST(Watcher, APayloadFromTheFirstRowIsToldAgainstTheCalibration) {
  const Robot robot = WatchedRobot();
  Watched watched(robot);
  watched.Add(WatchedLog(WithPayload(robot, .3), 6, 20));
  const auto changes = watched.Changes();
  ASSERT_EQ(changes.size(), 1);
  EXPECT_EQ(changes[0].kind, Kind::kPayload);
  EXPECT_TRUE(changes[0].since_calibration);
}

TEST(Watcher, FrictionIsToldOfItsJoint) {
  const Robot robot = WatchedRobot();
  Robot worn = robot;
  worn.links[1].joint.coulomb *= 1.6;
  Watched watched(robot);
  watched.Add(Changing(robot, worn, 22));
  const auto changes = watched.Changes();
  ASSERT_FALSE(changes.empty());
  EXPECT_EQ(changes.back().kind, Kind::kFriction);
  EXPECT_THAT(changes.back().joints, ElementsAre(robot.links[1].joint.name));
}

// A tenth of a second of 5 N m, which is fifty times the noise of a sample.
TEST(Watcher, AContactIsToldWithinFiftyMillisecondsAndEnds) {
  const Robot robot = WatchedRobot();
  Log log = WatchedLog(robot, 5, 30);
  for (int k = 22000; k < 22100; ++k) log.tau(k, 0) += 5;
  Watched watched(robot);
  watched.Add(log);
  const auto changes = watched.Changes();
  ASSERT_EQ(changes.size(), 1);
  EXPECT_EQ(changes[0].kind, Kind::kContact);
  EXPECT_GE(changes[0].time, 22);
  EXPECT_LE(changes[0].time, 22.05);
  EXPECT_EQ(changes[0].joints[0], robot.links[0].joint.name);
  EXPECT_EQ(watched.events.back().kind, Kind::kContactEnded);
}

TEST(Watcher, AHoleIsToldAndNoContact) {
  const Robot robot = WatchedRobot();
  Watched watched(robot);
  watched.Add(WatchedLog(robot, 4, 20));
  watched.Add(WatchedLog(robot, 8, 20), 25);
  EXPECT_THAT(watched.Changes(), IsEmpty());
  EXPECT_EQ(watched.events.back().kind, Kind::kHole);
  EXPECT_NEAR(watched.events.back().onset, 20, 1e-9);
}

// Without forgetting, all rows are one least squares problem: Householder's QR
// of all of them at once has the same solution to nine digits.
TEST(Watcher, TheWholeLogsEstimateIsTheBatchOne) {
  const Robot robot = WatchedRobot();
  Watched watched(robot);
  const int p = watched.watcher.model().size();
  std::vector<VectorXd> rows;
  watched.watcher.sink = [&](const MatrixXd& A, const VectorXd& r) {
    for (Eigen::Index i = 0; i < r.size(); ++i) {
      rows.emplace_back(p + 1);
      rows.back() << A.row(i).transpose(), r[i];
    }
  };
  watched.Add(WatchedLog(WithPayload(robot, .1), 4, 20));
  MatrixXd all(rows.size(), p + 1);
  for (size_t k = 0; k < rows.size(); ++k) all.row(k) = rows[k];
  ASSERT_GT(all.rows(), 3000);
  const VectorXd batch =
      watched.watcher.model().x +
      VectorXd(all.leftCols(p).colPivHouseholderQr().solve(all.col(p)));
  const auto estimate = watched.watcher.WholeLogEstimate();
  ASSERT_EQ(static_cast<int>(estimate.size()), p);
  for (int k = 0; k < p; ++k) {
    EXPECT_NEAR(estimate[k].value, batch[k], 1e-9 * batch.norm())
        << estimate[k].name;
  }
}

// What a thousand seconds need is what a hundred need.
TEST(Watcher, StatesStayOfOneSize) {
  const Robot robot = WatchedRobot();
  Watched watched(robot);
  const Log log = WatchedLog(robot, 4, 20);
  for (int part = 0; part < 10; ++part) watched.Add(log, 25. * part);
  EXPECT_EQ(watched.watcher.State().residual.size(), 3);
  EXPECT_LT(watched.events.size(), 12);
}

}  // namespace armcal::watcher_test
