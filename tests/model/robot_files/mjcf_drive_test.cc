#include "model/robot_files/mjcf_drive.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "model/robot_files/robot_formats.h"
#include "model/robot_files/robot_reader.h"
#include "tests/fixtures/temp_file.h"
#include "tests/fixtures/two_link_arm.h"
#include "tests/fixtures/written_mjcf.h"

namespace armcal::mjcf_drive_test {

using testing::ElementsAre;
using testing::HasSubstr;

RobotDescription Arm(DriveKind kind) {
  RobotDescription description{TwoLinkArm().ToNamedRobot(), {}};
  description.controller =
      DefaultController(description.robot, Eigen::Vector2d::Zero(), 5, kind);
  description.controller->feedforward = Feedforward::kNone;
  return description;
}

// Numbers of the first actuator's attribute.
std::vector<double> Numbers(const std::string& mjcf, const std::string& tag,
                            const std::string& attribute) {
  tinyxml2::XMLDocument document;
  document.Parse(mjcf.c_str());
  const auto* element = document.RootElement()
                            ->FirstChildElement("actuator")
                            ->FirstChildElement(tag.c_str());
  if (element == nullptr || element->Attribute(attribute.c_str()) == nullptr) {
    ADD_FAILURE() << tag << " " << attribute << "\n" << mjcf;
    return {};
  }
  return armcal::Numbers(element, attribute.c_str());
}

// MuJoCo's pid pushes with kp e + kv (qd_ref - v) + ki int e. Along any motion
// that begins without an error this is what the cascade does.
TEST(MjcfDrive, CascadeIsMultipliedOutToAPid) {
  const RobotDescription description = Arm(DriveKind::kCascade);
  const DriveLaw& law = description.controller->drives[0];
  const std::string mjcf = MakeMjcf(description);
  const double kp = Numbers(mjcf, "pid", "kp")[0];
  const double kv = Numbers(mjcf, "pid", "kv")[0];
  const double ki = Numbers(mjcf, "pid", "ki")[0];
  const double h = 1e-5;
  double integral = 0, of_error = 0;
  for (int k = 0; k < 100000; ++k) {
    const double t = k * h;
    const DriveInput at{std::sin(3 * t), 3 * std::cos(3 * t), 0,
                        .9 * std::sin(3 * t) + .05 * std::sin(7 * t),
                        2.7 * std::cos(3 * t) + .35 * std::cos(7 * t)};
    const DriveOutput out = Drive(law, at, integral);
    const double e = at.q_ref - at.q;
    if (k % 10000 == 0) {
      EXPECT_NEAR(out.torque, kp * e + kv * (at.qd_ref - at.v) + ki * of_error,
                  1e-3 * law.kd)
          << t;
    }
    integral += h * out.integral_rate;
    of_error += h * e;
  }
}

// A limit of the motor below the file's effort, and what becomes of one that
// falls with speed.
TEST(MjcfDrive, LimitsOfTheMotorAreItsControls) {
  RobotDescription description{TwoLinkArm().ToNamedRobot(), {}};
  description.robot.links[0].joint.effort = 40;
  EXPECT_THAT(Numbers(MakeMjcf(description), "motor", "ctrlrange"),
              ElementsAre(-40, 40));
  description.drives.resize(2);
  description.drives[0].torque_limit = 30;
  EXPECT_THAT(Numbers(MakeMjcf(description), "motor", "ctrlrange"),
              ElementsAre(-30, 30));
  EXPECT_TRUE(MjcfFormat().Holds(Joint(), description.drives[0]));
  description.drives[0].torque_limit_slope = 2;
  EXPECT_FALSE(MjcfFormat().Holds(Joint(), description.drives[0]));
  EXPECT_THAT(Losses(MjcfFormat(), description),
              testing::Contains(HasSubstr("fall with speed (joint1 2)")));
}

TEST(MjcfDrive, DelaysAndLagsAreWritten) {
  RobotDescription description = Arm(DriveKind::kP);
  description.controller->delay = .0055;
  std::string mjcf = MakeMjcf(description);
  EXPECT_THAT(Numbers(mjcf, "general", "delay"), ElementsAre(.0055));
  // Samples of 1 ms, one more than the delay spans.
  EXPECT_THAT(Numbers(mjcf, "general", "nsample"), ElementsAre(7));
  description.controller->drives[0].lag = .003;
  description.controller->drives[0].torque_limit = 20;
  mjcf = MakeMjcf(description);
  EXPECT_THAT(Numbers(mjcf, "dcmotor", "inductance"), ElementsAre(0, .003));
  const double ohm = Numbers(mjcf, "dcmotor", "resistance")[0];
  EXPECT_EQ(Numbers(mjcf, "dcmotor", "controller")[5], 20 * ohm);
}

// The robot behind the drives comes back.
TEST(MjcfDrive, ReadsBackAsTheSameRobot) {
  RobotDescription description = Arm(DriveKind::kP);
  description.robot.links[1].joint.offset = .7;
  description.robot.links[1].joint.effort = 12;
  description.controller->drives[1].torque_limit = 12;
  const Robot back =
      ReadRobot(WriteFile(MakeMjcf(description), "robot.xml"), {});
  EXPECT_DOUBLE_EQ(back.links[1].joint.offset, .7);
  EXPECT_DOUBLE_EQ(back.links[1].joint.effort, 12);
}

TEST(MjcfDrive, SaysWhatMujocoLacks) {
  RobotDescription description = Arm(DriveKind::kCascade);
  DriveLaw& law = description.controller->drives[0];
  EXPECT_THAT(MjcfDriveLosses(description), testing::IsEmpty());
  law.velocity_limit = 2;
  law.velocity_feedforward = .75;
  law.torque_limit = 30;
  EXPECT_THAT(
      MjcfDriveLosses(description),
      ElementsAre(HasSubstr("do not limit the velocity that a cascade asks for "
                            "(joint1 2)"),
                  HasSubstr("this share of the reference's velocity (joint1 "
                            "0.75)"),
                  HasSubstr("not this share less (joint1 0.25)"),
                  HasSubstr("do not stop at the torque limit (joint1 30)")));
  for (const RobotFormat& format : RobotFormats()) {
    if (format.Holds(RobotField::kController)) continue;
    EXPECT_THAT(Losses(format, description),
                testing::Contains(HasSubstr("has no field for controllers")));
  }
}

}  // namespace armcal::mjcf_drive_test
