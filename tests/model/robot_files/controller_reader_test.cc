#include "model/robot_files/controller_reader.h"

#include <gmock/gmock.h>

#include <cmath>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"
#include "tests/fixtures/two_link_arm.h"

namespace armcal::controller_reader_test {

using Eigen::Vector2d;

ControllerOptions Read(const std::string& text) {
  return ReadController(WriteFile(text, "controller.yaml"),
                        TwoLinkArm().ToRobot(), Vector2d(0, 0));
}

Vector2d Values(const ControllerOptions& options, double DriveLaw::*value) {
  return {options.drives[0].*value, options.drives[1].*value};
}

TEST(ReadController, ReadsEveryKey) {
  const ControllerOptions options = Read(
      "rate: 500\nkp: [1, 2]\nkd: [3, 4]\nki: [5, 6]\n"
      "velocity_feedforward: [0, .5]\ntorque_limit: [7, 8]\n"
      "lag: [.001, 0]\ndelay: .004\nvelocity_filter: 9\n"
      "feedforward: gravity\n");
  EXPECT_EQ(options.kind, DriveKind::kPd);
  EXPECT_EQ(options.rate_hz, 500);
  EXPECT_EQ(Values(options, &DriveLaw::kp), Vector2d(1, 2));
  EXPECT_EQ(Values(options, &DriveLaw::kd), Vector2d(3, 4));
  EXPECT_EQ(Values(options, &DriveLaw::ki), Vector2d(5, 6));
  EXPECT_EQ(Values(options, &DriveLaw::velocity_feedforward), Vector2d(0, .5));
  EXPECT_EQ(Values(options, &DriveLaw::torque_limit), Vector2d(7, 8));
  EXPECT_EQ(Values(options, &DriveLaw::lag), Vector2d(.001, 0));
  EXPECT_EQ(options.delay, .004);
  EXPECT_EQ(options.velocity_filter_hz, 9);
  EXPECT_EQ(options.feedforward, Feedforward::kGravity);
}

TEST(ReadController, ReadsACascade) {
  const ControllerOptions options = Read(
      "law: cascade\nposition_gain: [1, 2]\nkd: [3, 4]\n"
      "velocity_ki: [5, 6]\nvelocity_limit: [7, 8]\n");
  EXPECT_EQ(options.kind, DriveKind::kCascade);
  EXPECT_EQ(Values(options, &DriveLaw::position_gain), Vector2d(1, 2));
  EXPECT_EQ(Values(options, &DriveLaw::kd), Vector2d(3, 4));
  EXPECT_EQ(Values(options, &DriveLaw::velocity_ki), Vector2d(5, 6));
  EXPECT_EQ(Values(options, &DriveLaw::velocity_limit), Vector2d(7, 8));
  EXPECT_EQ(Values(options, &DriveLaw::kp), Vector2d(0, 0));
  EXPECT_EQ(Values(options, &DriveLaw::ki), Vector2d(0, 0));
  EXPECT_EQ(options.feedforward, Feedforward::kNone);
}

// A proportional drive brakes the joint, not its error.
TEST(ReadController, ReadsADriveOfItsOwnDamping) {
  const ControllerOptions options = Read("law: p\nkp: [1, 2]\n");
  EXPECT_EQ(options.kind, DriveKind::kP);
  EXPECT_EQ(Values(options, &DriveLaw::kp), Vector2d(1, 2));
  EXPECT_EQ(Values(options, &DriveLaw::ki), Vector2d(0, 0));
  EXPECT_EQ(Values(options, &DriveLaw::velocity_feedforward), Vector2d(0, 0));
  EXPECT_GT(options.drives[0].kd, 0);
}

// The integral gain goes with the gains that the file has: ki = kp w / 5, and
// of a cascade velocity_ki = kd w, w = 2 pi times the bandwidth of 8 or 4 Hz.
TEST(ReadController, IntegralGainsFollowTheGainsThatAreGiven) {
  const double w = 2 * M_PI * 8;
  ControllerOptions options = Read("kp: [300, 20]\nkd: [30, 2]\n");
  EXPECT_NEAR(options.drives[0].ki, 300 * w / 5, 1e-9);
  EXPECT_NEAR(options.drives[1].ki, 20 * w / 5, 1e-9);
  options = Read("bandwidth: 4\nkp: [300, 20]\n");
  EXPECT_NEAR(options.drives[0].ki, 300 * w / 10, 1e-9);
  options = Read("law: cascade\nkd: [30, 2]\n");
  EXPECT_NEAR(options.drives[0].velocity_ki, 30 * w, 1e-9);
  options = Read("kp: [300, 20]\nki: [0, 7]\n");
  EXPECT_EQ(Values(options, &DriveLaw::ki), Vector2d(0, 7));
}

TEST(ReadController, RefusesWhatIsWrong) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      Read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal("kp: [1]\n"), HasSubstr("expected 2 numbers, one per"));
  EXPECT_THAT(refusal("kp: [1, -1]\n"), HasSubstr("at least 0"));
  EXPECT_THAT(refusal("rate: 0\n"), HasSubstr("expected a number above 0"));
  EXPECT_THAT(refusal("gain: 3\n"), HasSubstr("gain"));
  EXPECT_THAT(refusal("feedforward: full\n"), HasSubstr("inverse_dynamics"));
  EXPECT_THAT(refusal("law: pid\n"), HasSubstr("one of pd, p, cascade"));
  EXPECT_THAT(refusal("law: p\nki: [1, 1]\n"), HasSubstr("law p has no ki"));
  EXPECT_THAT(refusal("velocity_limit: [1, 1]\n"),
              HasSubstr("law pd has no velocity_limit"));
  EXPECT_THAT(refusal("delay: 4\n"), HasSubstr("in milliseconds?"));
  EXPECT_THAT(refusal("lag: [0, 2]\n"), HasSubstr("in milliseconds?"));
}

}  // namespace armcal::controller_reader_test
