#include "model/robot_files/mjcf_laws.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "model/robot_files/robot_reader.h"
#include "tests/fixtures/temp_file.h"
#include "tests/fixtures/written_mjcf.h"

namespace armcal::mjcf_laws_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using tinyxml2::XMLElement;

using Written = WrittenMjcf;

RobotDescription Arm() { return ArmForMjcf(); }

Robot ReadBack(const Written& written) {
  return ReadRobot(WriteFile(written.text(), "laws.xml"), {});
}

// The motor keeps name, armature and friction; the link is on a joint of the
// same axis behind it. armcal reads the two as the one that they were.
TEST(MjcfLaws, AGearIsASecondJointOfTheBody) {
  RobotDescription arm = Arm();
  arm.drives[1].gear = GearSpring{0, 900, 3, .5};
  const Written written(arm);
  const XMLElement* motor = written.Named("joint", "joint2");
  const XMLElement* gear = written.Named("joint", "joint2_gear");
  EXPECT_EQ(motor->NextSiblingElement(), gear);
  EXPECT_STREQ(gear->Attribute("axis"), motor->Attribute("axis"));
  EXPECT_STREQ(gear->Attribute("pos"), motor->Attribute("pos"));
  EXPECT_THAT(Numbers(gear, "stiffness"), ElementsAre(900, 0, 450));
  EXPECT_THAT(Numbers(gear, "damping"), ElementsAre(3));
  EXPECT_EQ(gear->Attribute("armature"), nullptr);
  EXPECT_THAT(Numbers(motor, "armature"), ElementsAre(.2));
  EXPECT_EQ(written.All("motor").size(), 2);
  const Robot robot = ReadBack(written);
  ASSERT_EQ(robot.num_joints(), 2);
  EXPECT_EQ(robot.links[1].joint.armature, .2);
  EXPECT_EQ(robot.links[1].joint.coulomb, 3);
  EXPECT_EQ(robot.links[1].name, "link2");
  EXPECT_THAT(robot.notes, Contains(HasSubstr("joints are rigid")));
}

// The flanks are soft limits: a spring and a damper of accelerations.
TEST(MjcfLaws, AGapIsTheRangeOfTheGear) {
  RobotDescription arm = Arm();
  arm.drives[0].gear = GearSpring{.004, 900, 3, 0};
  const Written once(arm);
  const XMLElement* gear = once.Named("joint", "joint1_gear");
  EXPECT_THAT(Numbers(gear, "range"), ElementsAre(-.002, .002));
  EXPECT_EQ(gear->Attribute("stiffness"), nullptr);
  const std::vector<double> flank = Numbers(gear, "solreflimit");
  ASSERT_EQ(flank.size(), 2);
  EXPECT_LT(flank[0], 0);
  EXPECT_NEAR(flank[0] / flank[1], 300, 1e-9);
  EXPECT_EQ(ReadBack(once).num_joints(), 2);
}

TEST(MjcfLaws, BristlesAndWavesArePassiveMotors) {
  RobotDescription arm = Arm();
  arm.drives[0].bristles = {{200, 1.5, 2, .1}, {50, .5, .5}};
  arm.drives[1].waves = {{.7, 12.5, .3}};
  const Written written(arm);
  const std::vector<const XMLElement*> motors = written.All("dcmotor");
  ASSERT_EQ(motors.size(), 3);
  for (const XMLElement* motor : motors) {
    EXPECT_STREQ(motor->Attribute("input"), "none");
  }
  EXPECT_THAT(Numbers(motors[0], "lugre"), ElementsAre(200, 0, 1.5, 2, .1));
  EXPECT_STREQ(motors[1]->Attribute("name"), "joint1_bristles2");
  EXPECT_THAT(Numbers(motors[2], "cogging"), ElementsAre(.7, 12.5, .3));
  // What bristles are to a joint that moves on is read, and motors have their
  // effort still.
  arm.robot.links[0].joint.effort = 80;
  const Robot robot = ReadBack(Written(arm));
  EXPECT_EQ(robot.links[0].joint.coulomb, 3 + 1.5 + .5);
  EXPECT_EQ(robot.links[1].joint.coulomb, 3);
  EXPECT_EQ(robot.links[0].joint.effort, 80);
  EXPECT_THAT(MjcfFormat().more_losses(arm),
              Contains(HasSubstr("3.12 or later")));
}

// The largest part of friction is the joint's, others are of tendons.
TEST(MjcfLaws, DryFrictionIsInParts) {
  RobotDescription arm = Arm();
  arm.drives[1].dry = {{.5, .001}, {2, .01}, {.5, .1}};
  const Written written(arm);
  const XMLElement* joint = written.Named("joint", "joint2");
  EXPECT_THAT(Numbers(joint, "frictionloss"), ElementsAre(2));
  const XMLElement* sharp = written.Named("fixed", "joint2_friction");
  EXPECT_THAT(Numbers(sharp, "frictionloss"), ElementsAre(.5));
  EXPECT_NE(written.Named("fixed", "joint2_friction2"), nullptr);
  // Damping goes with force over width.
  EXPECT_NEAR(
      Numbers(sharp, "solreffriction")[1] / Numbers(joint, "solreffriction")[1],
      2.5, 1e-12);
  EXPECT_EQ(ReadBack(written).links[1].joint.coulomb, 3);
  EXPECT_THAT(MjcfFormat().more_losses(arm), IsEmpty());
}

TEST(MjcfLaws, QuadraticFrictionIsTheSecondDamping) {
  RobotDescription arm = Arm();
  arm.drives[0].quadratic = .25;
  const Written written(arm);
  EXPECT_THAT(Numbers(written.Named("joint", "joint1"), "damping"),
              ElementsAre(2, .25));
  const Robot robot = ReadBack(written);
  EXPECT_EQ(robot.links[0].joint.viscous, 2);
  EXPECT_THAT(robot.notes, Contains(HasSubstr("linear part")));
}

TEST(MjcfLaws, MotorsAreLateByTheDelay) {
  RobotDescription arm = Arm();
  arm.torque_delay = .0042;
  const Written written(arm);
  EXPECT_THAT(Numbers(written.All("option")[0], "timestep"), ElementsAre(5e-4));
  EXPECT_THAT(MjcfFormat().more_losses(arm),
              ElementsAre(HasSubstr("3.8 or later")));
  for (const XMLElement* motor : written.All("motor")) {
    EXPECT_THAT(Numbers(motor, "delay"), ElementsAre(.0042));
    EXPECT_THAT(Numbers(motor, "nsample"), ElementsAre(10));
  }
}

// A stiff gear wants short steps, and none shorter than 0.1 ms.
TEST(MjcfLaws, StepsAreShortEnough) {
  RobotDescription arm = Arm();
  const auto step = [&](double stiffness) {
    arm.drives[1].gear = GearSpring{0, stiffness, 0, 0};
    return Numbers(Written(arm).All("option")[0], "timestep")[0];
  };
  EXPECT_EQ(step(100), 5e-4);
  EXPECT_LT(step(1e6), 5e-4);
  EXPECT_EQ(step(1e9), 1e-4);
  EXPECT_THAT(MjcfFormat().more_losses(arm),
              Contains(HasSubstr("softer than 1e+09")));
  EXPECT_LT(Numbers(Written(arm).Named("joint", "joint2_gear"), "stiffness")[0],
            1e9);
}

// Without laws nothing is written but what there was.
TEST(MjcfLaws, NothingWithoutLaws) {
  const Written written(Arm());
  EXPECT_EQ(written.All("option")[0]->Attribute("timestep"), nullptr);
  for (const char* tag : {"tendon", "dcmotor"}) {
    EXPECT_THAT(written.All(tag), IsEmpty());
  }
  EXPECT_THAT(written.text(), Not(HasSubstr("solref")));
}

// Two joints on one axis are two where both are driven, or the second is free.
TEST(MjcfLaws, OnlyWhatYieldsIsReadAsAGear) {
  const auto joints = [](const std::string& second,
                         const std::string& sections) {
    const std::string xml =
        "<mujoco><worldbody><body name='a'><inertial pos='0 0 0' mass='1' "
        "diaginertia='1 1 1'/><joint name='x'/><joint name='y' " +
        second + "/></body></worldbody>" + sections + "</mujoco>";
    return ReadRobot(WriteFile(xml, "two.xml"), {}).num_joints();
  };
  EXPECT_EQ(joints("stiffness='5'", ""), 1);
  EXPECT_EQ(joints("range='-1 1'", ""), 1);
  EXPECT_EQ(joints("", ""), 2);
  EXPECT_EQ(joints("stiffness='5' pos='.1 0 0'", ""), 2);
  EXPECT_EQ(joints("stiffness='5' axis='0 1 0'", ""), 2);
  EXPECT_EQ(joints("stiffness='5'",
                   "<actuator><motor name='y' joint='y'/></actuator>"),
            2);
}

}  // namespace armcal::mjcf_laws_test
