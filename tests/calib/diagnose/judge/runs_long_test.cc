#include <cmath>

#include "calib/diagnose/diagnosis.h"
#include "calib/diagnose/judge/runs.h"
#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::runs_long_test {

class GapRunsTest : public DiagnosedArm<25> {
 protected:
  // Logs of an arm whose second joint has this much more viscous friction.
  std::vector<RunDrift> Drifts(const std::vector<double>& viscous) {
    std::vector<std::string> paths;
    for (const double more : viscous) {
      SimulatedRobot robot = plant_->Bare();
      AddTo("viscous_friction", 1, {more}, &robot);
      paths.push_back(
          Record(robot, "log" + std::to_string(paths.size()) + ".csv"));
    }
    LogReaderOptions reader;
    reader.joint_names = File().JointNames();
    LogSet logs(LogFiles(paths), reader, {});
    DiagnosisOptions options;
    options.bandwidth_hz = 6;
    options.forward = false;
    return DiagnoseGap(File(), options, logs, nullptr, nullptr).drifts;
  }
};

TEST_F(GapRunsTest, FrictionThatGrowsFromLogToLogIsListed) {
  const std::vector<RunDrift> drifts = Drifts({0, .3, .6, .9});
  ASSERT_EQ(drifts.size(), 1u);
  EXPECT_EQ(drifts[0].name, File().links[1].joint.name + ".viscous");
  EXPECT_EQ(drifts[0].unit, "N m s/rad");
  EXPECT_NEAR(drifts[0].per_log, .3, 4 * drifts[0].per_log_stddev + .01);
  EXPECT_LT(drifts[0].per_log_stddev, .05);
  EXPECT_NEAR(drifts[0].value[3] - drifts[0].value[0], .9, .1);
}

TEST_F(GapRunsTest, NothingDriftsWhereNothingChangesOrChangesBack) {
  EXPECT_TRUE(Drifts({0, 0, 0, 0}).empty());
  EXPECT_TRUE(Drifts({0, .6, .6, 0}).empty());
  EXPECT_TRUE(Drifts({0, .9}).empty());  // two logs make no line
}

}  // namespace armcal::runs_long_test
