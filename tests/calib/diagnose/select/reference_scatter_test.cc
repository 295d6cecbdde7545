#include "calib/diagnose/select/reference_scatter.h"

#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/segments.h"
#include "calib/diagnose/select/reference_fit.h"
#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::reference_scatter_test {

// Student's t of 4 degrees of freedom, 99 % of its size: 4.604 (tables), and a
// sixth log differs from the mean of five by sqrt(1 + 1/5) of their deviation.
TEST(ReferenceScatter, IsJudgedByStudentsT) {
  const double limit = 1 / (4.604 * std::sqrt(1.2));
  EXPECT_TRUE((ReferenceScatter{5, .99 * limit, 4}.IsBeyond(.99)));
  EXPECT_FALSE((ReferenceScatter{5, 1.01 * limit, 4}.IsBeyond(.99)));
}

// Six joints of three logs each: F of 2 and 10 degrees is 4.103 at 5 %
// (tables), t of 12 degrees 3.055 at 99 % instead of 9.925.
TEST(ReferenceScatter, IsThatOfAllJoints) {
  const ReferenceScatter own{3, .2, 2, .1};
  const std::vector<ReferenceScatter> others(5, {3, .3, 2, .1});
  const ReferenceScatter pooled = PooledScatter(own, others);
  EXPECT_EQ(pooled.freedom, 12);
  EXPECT_NEAR(pooled.stddev, .1 * std::sqrt((5 * 9. + 4) / 6), 1e-12);
  const double limit = 1 / (3.055 * std::sqrt(4. / 3));
  EXPECT_TRUE((ReferenceScatter{3, .99 * limit, 12}.IsBeyond(.99)));
  EXPECT_FALSE((ReferenceScatter{3, 1.01 * limit, 12}.IsBeyond(.99)));
}

TEST(ReferenceScatter, OfAJointThatScattersMoreIsItsOwn) {
  const std::vector<ReferenceScatter> others(5, {3, .1, 2, .1});
  EXPECT_EQ(PooledScatter({3, .20, 2, .1}, others).freedom, 12);
  EXPECT_EQ(PooledScatter({3, .21, 2, .1}, others).freedom, 2);
  EXPECT_EQ(PooledScatter({3, .21, 2, .1}, others).stddev, .21);
  EXPECT_EQ(PooledScatter({3, .1, 2, .1}, {}).freedom, 2);
}

TEST(ReferenceScatter, OfTwoLogsTellsNothing) {
  EXPECT_TRUE((ReferenceScatter{2, 10, 1}.IsBeyond(.99)));
  EXPECT_TRUE(ReferenceScatter().IsBeyond(.99));
}

using ReferenceScatterTest = DiagnosedArm<32>;

// Three logs of an arm whose first joint has a cable that pulls by +1.5, 0 and
// -1.5 N m/rad: a standard deviation of 1.5.
TEST_F(ReferenceScatterTest, IsWhatLogsDifferBy) {
  // What all logs have alike, here 3 N m / rad, is no scatter.
  std::vector<std::string> paths;
  for (const double stiffness : {4.5, 3., 1.5}) {
    SimulatedRobot robot = before_;
    AddTo("spring", 0, {stiffness, 0}, &robot);
    paths.push_back(Record(robot, std::to_string(paths.size()) + ".csv"));
  }
  LogReaderOptions reader;
  reader.joint_names = File().JointNames();
  const LogSet logs(LogFiles(paths), reader, {});
  const std::vector<GapSegment> segments = ReadSegments(6, {}, logs);
  const GapBaseline baseline(File(), {}, UsualTorque(segments));
  GapData data(segments, baseline, 6);
  const Eigen::VectorXd x = FitWithNoise(&data);
  const MotionScale scale = ScaleOf(baseline, data.rows(), data.torques());
  GapCandidate spring;
  spring.effect = FindEffect("spring");
  spring.joint = 0;
  spring.p = Eigen::Vector2d(.75, 0);
  const ReferenceScatter scatter =
      ScatterBetweenLogs(baseline, scale, spring, x, &data);
  EXPECT_EQ(scatter.logs, 3);
  EXPECT_NEAR(scatter.stddev, 2, .2);
  // What acts on no log's motion is in none.
  spring.p.setZero();
  EXPECT_EQ(ScatterBetweenLogs(baseline, scale, spring, x, &data).logs, 0);
}

}  // namespace armcal::reference_scatter_test
