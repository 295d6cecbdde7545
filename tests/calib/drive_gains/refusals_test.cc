// Gains that logs do not show.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/drive_gain_runs.h"

namespace armcal::refusals_test {

using testing::HasSubstr;

// The same payload on the same log as bare: it weighs nothing.
TEST(DriveGainRefusals, PayloadThatIsNotThereIsRefused) {
  std::mt19937_64 random(9);
  DrivenArm driven = MakeDrivenArm("UR5 6R", &random);
  driven.payload = InertialParameters();
  Currents currents(driven, 15, &random);
  AddDriveNoise(.01, 1e-4, &random, &currents.bare);
  AddDriveNoise(.01, 1e-4, &random, &currents.loaded);
  const DriveGains result = EstimateFromLogs(
      driven.arm.file, 3, {currents.bare}, {currents.loaded}, DriveOptions());
  EXPECT_FALSE(result.solved);
  for (const DriveGain& gain : result.gains) {
    EXPECT_FALSE(gain.identifiable) << gain.name;
    EXPECT_THAT(gain.reason, HasSubstr("three standard deviations clear of 0"));
  }
}

// Horizontal SCARA whose wrist alone turns while it carries the payload: the
// lift feels the weight; the others feel its inertia about the wrist, which is
// unknown, and share none with the lift.
TEST(DriveGainRefusals, WristAloneShowsTheLiftOnly) {
  std::mt19937_64 random(10);
  const DrivenArm driven = MakeDrivenArm("SCARA RRPR", &random);
  const Log bare = ToCurrents(MoveArm(driven.arm.truth, 15, &random), driven.K);
  Multisine wrist = RandomMultisine(&random, 4, 1.2);
  wrist.amplitude.topRows(3).setZero();
  Log loaded = RecordMotion(wrist, 15, .01);
  AddTorque(Loaded(driven), &loaded);
  for (int j = 0; j < 4; ++j) {
    const Joint& joint = driven.arm.truth.links[j].joint;
    AddCoulomb(j, joint.coulomb, kTransition, &loaded);
    loaded.tau.col(j).array() += joint.offset;
  }
  Log noisy[] = {bare, ToCurrents(loaded, driven.K)};
  for (Log& log : noisy) AddDriveNoise(.01, 1e-5, &random, &log);
  const DriveGains result =
      EstimateFromLogs(driven.arm.file, driven.payload.mass, {noisy[0]},
                       {noisy[1]}, DriveOptions());
  EXPECT_FALSE(result.solved);
  for (const int j : {0, 1, 3}) {
    EXPECT_FALSE(result.gains[j].identifiable) << j;
  }
  ASSERT_TRUE(result.gains[2].identifiable) << result.gains[2].reason;
  EXPECT_NEAR(result.gains[2].value, driven.K[2], 4 * result.gains[2].stddev);
  EXPECT_LT(result.gains[2].stddev, .01 * driven.K[2]);
  EXPECT_THAT(result.reason, HasSubstr("of joint1, joint2, joint4: "));
}

TEST(DriveGainRefusals, JointWithoutCurrentIsNamed) {
  std::mt19937_64 random(11);
  const DrivenArm driven = MakeDrivenArm("3R elbow", &random);
  Currents currents(driven, 15, &random);
  currents.loaded.tau.col(0).setZero();
  const DriveGains result =
      EstimateFromLogs(driven.arm.file, driven.payload.mass, {currents.bare},
                       {currents.loaded}, ExactOptions());
  EXPECT_FALSE(result.solved);
  EXPECT_THAT(result.reason, HasSubstr("of joint1: its current is zero"));
  EXPECT_NEAR(result.gains[2].value / driven.K[2], 1, 1e-4);
}

TEST(DriveGainRefusals, ShortLogsAreRefused) {
  std::mt19937_64 random(12);
  const DrivenArm driven = MakeDrivenArm("Panda 7R", &random);
  const Currents currents(driven, 3, &random);
  const DriveGains result =
      EstimateFromLogs(driven.arm.file, driven.payload.mass, {currents.bare},
                       {currents.loaded}, ExactOptions());
  EXPECT_FALSE(result.solved);
  EXPECT_THAT(result.reason, HasSubstr("longer logs are needed"));
}

}  // namespace armcal::refusals_test
