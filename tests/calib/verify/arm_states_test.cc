#include "calib/verify/arm_states.h"

#include <gtest/gtest.h>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::arm_states_test {

TEST(RandomStates, FillTheLimitsAndStayWithin) {
  Robot robot = SampleRobot("SCARA RRPR");
  robot.links[0].joint.lower = -.5;
  robot.links[0].joint.upper = 2;
  robot.links[0].joint.velocity = 7;
  const auto states = RandomStates(robot, 500, 3);
  ASSERT_EQ(states.size(), 500u);
  const double low[] = {-.5, -M_PI, -1, -M_PI}, high[] = {2, M_PI, 1, M_PI};
  const double speed[] = {7, 2, .5, 2};
  for (int j = 0; j < 4; ++j) {
    double least = 1e9, most = -1e9, fastest = 0;
    for (const ArmState& s : states) {
      least = std::min(least, s.q[j]);
      most = std::max(most, s.q[j]);
      fastest = std::max(fastest, std::abs(s.qd[j]));
    }
    const double margin = .03 * (high[j] - low[j]);
    EXPECT_TRUE(least >= low[j] && least < low[j] + margin) << least;
    EXPECT_TRUE(most <= high[j] && most > high[j] - margin) << most;
    EXPECT_TRUE(fastest <= speed[j] && fastest > .97 * speed[j]) << fastest;
  }
}

// Of two logs, as many as asked for from their whole length, those of both.
TEST(LoggedStates, SpreadEvenly) {
  std::mt19937_64 random(1);
  const Multisine motion = RandomMultisine(&random, 2);
  Robot robot = SampleRobot("2R planar (horizontal)");
  SetRandomInertials(&random, &robot);
  std::vector<std::string> paths;
  for (const char* name : {"a.csv", "b.csv"}) {
    Log log = RecordMotion(motion, 20, .01);
    AddTorque(robot, &log);
    paths.push_back(WriteFile(LogCsv(log, true), name));
  }
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  LogSet logs(LogFiles(paths), reader, {});
  const auto states = LoggedStates(100, nullptr, Prepare(logs, {}));
  ASSERT_EQ(states.size(), 100u);
  const Log log = RecordMotion(motion, 20, .01);
  for (int k = 0; k < 100; ++k) {
    const double t = std::fmod(k * .4002, 20.01);
    const int row = static_cast<int>(std::lround(t / .01)) % log.size();
    double nearest = 1e9;
    for (int d = -1; d <= 1; ++d) {
      const int at = std::clamp(row + d, 0, log.size() - 1);
      nearest = std::min(
          nearest, (states[k].q.transpose() - log.q.row(at)).norm() +
                       (states[k].qdd.transpose() - log.qdd.row(at)).norm());
    }
    EXPECT_LT(nearest, 1e-9) << k;
  }
}

}  // namespace armcal::arm_states_test
