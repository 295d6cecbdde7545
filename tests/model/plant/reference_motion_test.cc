#include "model/plant/reference_motion.h"

#include <gmock/gmock.h>

#include <cmath>

#include "model/plant/motion_reader.h"
#include "model/text/input_error.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::reference_motion_test {

Robot LimitedPanda() {
  Robot robot = SampleRobot("Panda 7R");
  for (int j = 0; j < 7; ++j) {
    robot.links[j].joint.lower = -.5 - .2 * j;
    robot.links[j].joint.upper = .3;
    robot.links[j].joint.velocity = .4 + .1 * j;
  }
  return robot;
}

// Rates are the differences of what they are rates of, limits hold, and the
// motion begins and ends at rest.
void ExpectMotionWithin(const ReferenceMotion& motion, const Robot& robot) {
  const double h = 1e-5;
  for (double t = h; t < motion.duration - h; t += .0371) {
    const ReferencePoint at = motion.at(t);
    const ReferencePoint before = motion.at(t - h), after = motion.at(t + h);
    ASSERT_LT(((after.q - before.q) / (2 * h) - at.qd).norm(), 1e-5) << t;
    ASSERT_LT(((after.qd - before.qd) / (2 * h) - at.qdd).norm(), 1e-3) << t;
    for (int j = 0; j < robot.num_joints(); ++j) {
      ASSERT_GE(at.q[j], robot.links[j].joint.lower) << t;
      ASSERT_LE(at.q[j], robot.links[j].joint.upper) << t;
    }
  }
  EXPECT_LT(motion.at(0).qd.norm(), 1e-12);
  EXPECT_LT(motion.at(motion.duration).qd.norm(), 1e-12);
}

TEST(FourierMotion, StaysWithinLimitsAndRepeats) {
  const Robot robot = LimitedPanda();
  MotionOptions options;
  options.duration = 23;
  options.size = 1;
  const ReferenceMotion motion = FourierMotion(robot, options);
  ExpectMotionWithin(motion, robot);
  EXPECT_LT((motion.at(3).q - motion.at(13).q).norm(), 1e-9);
  Eigen::VectorXd fastest = Eigen::VectorXd::Zero(7);
  for (double t = 1; t < 11; t += .01) {
    fastest = fastest.cwiseMax(motion.at(t).qd.cwiseAbs());
  }
  for (int j = 0; j < 7; ++j) {
    EXPECT_LE(fastest[j], 1.001 * robot.links[j].joint.velocity) << j;
  }
}

TEST(PointToPointMotion, RestsBetweenMovesWithinLimits) {
  const Robot robot = LimitedPanda();
  MotionOptions options;
  options.size = 1;
  const ReferenceMotion motion = PointToPointMotion(robot, options);
  ExpectMotionWithin(motion, robot);
  int resting = 0;
  for (double t = 0; t < options.duration; t += .01) {
    resting += motion.at(t).qd.norm() == 0;
    for (int j = 0; j < 7; ++j) {
      ASSERT_LE(std::abs(motion.at(t).qd[j]),
                robot.links[j].joint.velocity * (1 + 1e-12));
    }
  }
  EXPECT_GT(resting, 100);
}

TEST(BuiltInMotions, OnlyTheJointsAskedForMove) {
  MotionOptions options;
  options.joints = {2};
  for (const auto& motion : {FourierMotion(LimitedPanda(), options),
                             PointToPointMotion(LimitedPanda(), options)}) {
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(7);
    for (double t = 0; t < 20; t += .1) moved += motion.at(t).qd.cwiseAbs();
    EXPECT_GT(moved[2], 1);
    moved[2] = 0;
    EXPECT_EQ(moved.norm(), 0);
  }
}

TEST(WithStandstill, HoldsBeforeAndAfter) {
  const ReferenceMotion motion = FourierMotion(LimitedPanda(), {});
  const ReferenceMotion rests = WithStandstill(motion, 2, 3);
  EXPECT_EQ(rests.duration, motion.duration + 5);
  EXPECT_EQ(rests.at(1).qd.norm(), 0);
  EXPECT_EQ(rests.at(1).q, motion.at(0).q);
  EXPECT_EQ(rests.at(7).q, motion.at(5).q);
  EXPECT_EQ(rests.at(24).q, motion.at(20).q);
}

TEST(ReadReferenceMotion, GoesThroughRowsAndIsSmoothBetween) {
  std::mt19937_64 random(1);
  const Robot robot = SampleRobot("SCARA RRPR");
  const Multisine sines = RandomMultisine(&random, 4);
  const Log coarse = RecordMotion(sines, 5, .02);
  const Log fine = RecordMotion(sines, 5, .005);
  for (const bool with_rates : {true, false}) {
    const ReferenceMotion motion =
        ReadReferenceMotion(WriteFile(LogCsv(coarse, with_rates)), robot);
    EXPECT_NEAR(motion.duration, 5, 1e-9);
    for (int k = 20; k < 980; ++k) {
      const ReferencePoint at = motion.at(fine.t[k]);
      ASSERT_LT((at.q - fine.q.row(k).transpose()).norm(),
                with_rates ? 1e-8 : 1e-4);
      ASSERT_LT((at.qd - fine.qd.row(k).transpose()).norm(),
                with_rates ? 1e-6 : 1e-2);
    }
  }
}

// Between rows of any distance a polynomial of fifth order is what it is.
TEST(ReadReferenceMotion, FollowsAFifthOrderPolynomialAtUnevenTimes) {
  const auto at = [](double t) {
    return Eigen::Vector3d(1 - t + t * t / 2 - std::pow(t, 5) / 8,
                           -1 + t - 5 * std::pow(t, 4) / 8,
                           1 - 5 * std::pow(t, 3) / 2);
  };
  std::string text = "t,q1,qd1,qdd1\n";
  for (const double t : {0., .1, .9, 1., 1.7, 2.}) {
    char row[160];
    const Eigen::Vector3d x = at(t);
    std::snprintf(row, sizeof row, "%.17g,%.17g,%.17g,%.17g\n", t, x[0], x[1],
                  x[2]);
    text += row;
  }
  Robot robot = SampleRobot("SCARA RRPR");
  robot.links.resize(1);
  const ReferenceMotion motion = ReadReferenceMotion(WriteFile(text), robot);
  for (double t = 0; t <= 2; t += .01) {
    const ReferencePoint point = motion.at(t);
    const Eigen::Vector3d x = at(t);
    ASSERT_NEAR(point.q[0], x[0], 1e-12) << t;
    ASSERT_NEAR(point.qd[0], x[1], 1e-11) << t;
    ASSERT_NEAR(point.qdd[0], x[2], 1e-10) << t;
  }
}

// Who steps along it passes its end by rounding.
TEST(ReadReferenceMotion, StaysAtItsEnds) {
  Robot robot = SampleRobot("SCARA RRPR");
  robot.links.resize(1);
  const ReferenceMotion motion =
      ReadReferenceMotion(WriteFile("t,q1\n0,5\n1,6\n2,8\n3,9\n"), robot);
  EXPECT_NEAR(motion.at(3.0005).q[0], 9, 1e-12);
  EXPECT_NEAR(motion.at(-1e-9).q[0], 5, 1e-12);
}

TEST(ReadReferenceMotion, RefusesTimesThatStand) {
  const std::string path = WriteFile("t,q1\n0,0\n1,0\n1,.1\n2,.2\n3,.1\n");
  Robot robot = SampleRobot("SCARA RRPR");
  robot.links.resize(1);
  EXPECT_THAT([&] { ReadReferenceMotion(path, robot); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr(
                  "row 4: its time is that of the row before")));
}

}  // namespace armcal::reference_motion_test
