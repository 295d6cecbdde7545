#include "model/robot_files/isaac_writer.h"

#include <gmock/gmock.h>

#include "tests/fixtures/sample_robots.h"

namespace armcal::isaac_writer_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

RobotDescription MakeDescription() {
  RobotDescription description{SampleRobot("2R planar (vertical plane)"), {}};
  Joint& joint = description.robot.links[1].joint;
  joint.name = "elbow.pitch \"2\"";
  joint.viscous = .5;
  joint.coulomb = 1.25;
  joint.armature = .75;
  joint.effort = 40;
  return description;
}

TEST(IsaacWriter, HoldsFrictionArmatureAndLimits) {
  const std::string text = MakeIsaac(MakeDescription());
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("\"elbow.pitch \\\"2\\\"\": IdealPD"),
            HasSubstr("[\"elbow\\\\.pitch \\\"2\\\"\"]"),
            HasSubstr("viscous_friction=0.5,"), HasSubstr("friction=1.25,"),
            HasSubstr("dynamic_friction=1.25,"), HasSubstr("armature=0.75,"),
            HasSubstr("effort_limit=40,"), HasSubstr("stiffness=0,")));
  EXPECT_THAT(text, AllOf(Not(HasSubstr("inf")), Not(HasSubstr("delay"))));
}

// A motor that gives 60 N m at rest and 2 N m s/rad less as it turns.
TEST(IsaacWriter, HoldsWhatAVoltageLeaves) {
  RobotDescription description = MakeDescription();
  description.drives.resize(2);
  description.drives[1].torque_limit = 60;
  description.drives[1].torque_limit_slope = 2;
  const std::string text = MakeIsaac(description);
  EXPECT_THAT(text, AllOf(HasSubstr("import DCMotorCfg, IdealPDActuatorCfg\n"),
                          HasSubstr("\"elbow.pitch \\\"2\\\"\": DCMotorCfg("),
                          HasSubstr("effort_limit=40,"),
                          HasSubstr("saturation_effort=60,"),
                          HasSubstr("velocity_limit=30,")));
  description.drives[1].torque_limit_slope = 0;
  description.drives[1].torque_limit = 30;
  EXPECT_THAT(MakeIsaac(description),
              AllOf(Not(HasSubstr("DCMotor")), HasSubstr("effort_limit=30,")));
  // Which has no delay.
  description.drives[1].torque_limit_slope = 2;
  ControllerOptions controller;
  controller.drives.resize(2);
  controller.delay = .004;
  controller.feedforward = Feedforward::kNone;
  description.controller = controller;
  EXPECT_THAT(MakeIsaac(description),
              AllOf(Not(HasSubstr("DCMotor")), HasSubstr("effort_limit=30,")));
  EXPECT_THAT(IsaacFormat().more_losses(description),
              ElementsAre(HasSubstr("falls with speed (elbow.pitch")));
}

// A cascade of position gain 5 around a velocity loop of kd 8 and ki 3 is a PD
// loop of kp 5 * 8 + 3, and an integral that Isaac Lab has not.
TEST(IsaacWriter, HoldsTheDrives) {
  RobotDescription description = MakeDescription();
  ControllerOptions controller;
  controller.kind = DriveKind::kCascade;
  controller.drives.resize(2);
  controller.drives[1].position_gain = 5;
  controller.drives[1].kd = 8;
  controller.drives[1].velocity_ki = 3;
  controller.delay = .004;
  controller.feedforward = Feedforward::kNone;
  description.controller = controller;
  EXPECT_THAT(MakeIsaac(description),
              AllOf(HasSubstr("DELAY = 0.004"), HasSubstr("stiffness=43,"),
                    HasSubstr("damping=8,"),
                    HasSubstr("min_delay=delay, max_delay=delay")));
  EXPECT_THAT(IsaacFormat().more_losses(description),
              ElementsAre(HasSubstr("no integral gain")));
}

}  // namespace armcal::isaac_writer_test
