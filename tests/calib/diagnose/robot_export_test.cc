#include "calib/diagnose/robot_export.h"

#include <gmock/gmock.h>

#include "model/dynamics/inverse_dynamics.h"
#include "model/robot_files/urdf_writer.h"
#include "tests/calib/diagnose/corrected_export.h"

namespace armcal::robot_export_test {

using Eigen::VectorXd;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

using Export = CorrectedExport;

TEST_F(Export, UrdfHoldsFrictionAndBodies) {
  const RobotExport out =
      Of(arm_.HeavierLinks(arm_.Baseline(), 1.1),
         {Found("viscous_friction", 0, VectorXd::Constant(1, .7)),
          Found("coulomb_friction", 2, VectorXd::Constant(1, -.4))});
  const Robot robot = Read(out.urdf);
  EXPECT_NEAR(robot.links[0].joint.viscous, 3.7, 1e-9);
  EXPECT_NEAR(robot.links[1].joint.viscous, 3, 1e-9);
  EXPECT_NEAR(robot.links[2].joint.coulomb, 3.6, 1e-9);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(robot.links[i].inertial.mass,
                1.1 * arm_.file.links[i].inertial.mass, 1e-8);
  }
  EXPECT_THAT(out.losses, Not(Contains(HasSubstr("viscous_friction"))));
  EXPECT_THAT(out.losses, Contains(HasSubstr("armature")));
  EXPECT_TRUE(out.effects["effects"][0]["in_urdf"]);
}

TEST_F(Export, SaysWhatUrdfCannotHoldAndKeepsItBesides) {
  VectorXd x = Nothing();
  x[x.size() - 1] = 2;  // the timing's standard deviations of 0.5 ms
  const RobotExport out =
      Of(x, {Found("torque_offset", 1, VectorXd::Constant(1, .25))});
  EXPECT_THAT(out.losses,
              Contains("URDF has no field for torque_offset of joint " +
                       arm_.file.links[1].joint.name +
                       " (offset 0.25 N m): see effects.json"));
  EXPECT_THAT(out.losses, Contains(HasSubstr("1 ms after the motion")));
  EXPECT_THAT(out.losses, Contains(HasSubstr("through zero velocity")));
  const nlohmann::json& effect = out.effects["effects"][0];
  EXPECT_EQ(effect["effect"], "torque_offset");
  EXPECT_EQ(effect["joint_index"], 2);
  EXPECT_FALSE(effect["in_urdf"]);
  EXPECT_EQ(effect["parameters"][0]["name"], "offset");
  EXPECT_EQ(effect["parameters"][0]["unit"], "N m");
  EXPECT_EQ(effect["parameters"][0]["value"], .25);
  EXPECT_NEAR(out.effects["delay_s"], 1e-3, 1e-12);
}

// A spring is in MJCF and SDF, a gain in MJCF alone.
TEST_F(Export, FormatsHoldWhatTheyHaveFieldsFor) {
  const RobotExport out =
      Of(Nothing(), {Found("spring", 1, Eigen::Vector2d(20, 6)),
                     Found("torque_gain", 0, VectorXd::Constant(1, .25))});
  EXPECT_THAT(out.effects["effects"][0]["in"],
              ElementsAre("mjcf", "mjcf_plain", "sdf"));
  EXPECT_THAT(out.effects["effects"][1]["in"],
              ElementsAre("mjcf", "mjcf_plain"));
  std::map<std::string, RobotFile> files = ByFormat(out);
  EXPECT_THAT(files["mjcf"].text, AllOf(HasSubstr("stiffness=\"20\""),
                                        HasSubstr("springref=\"0.3\""),
                                        HasSubstr("gainprm=\"0.8\"")));
  EXPECT_THAT(files["mjcf"].losses, Not(Contains(HasSubstr("spring"))));
  EXPECT_THAT(files["yaml"].losses,
              Contains("YAML has no field for spring of joint " +
                       arm_.file.links[1].joint.name +
                       " (stiffness 20 N m/rad, neutral 0.3 rad): see "
                       "effects.json"));
  EXPECT_EQ(RobotFilesJson(out.files)[0]["file"], "robot.urdf");
}

// Read back, the motors of yielding joints are the joints, and friction is what
// a joint that moves on has of it.
TEST_F(Export, MjcfOfLawsIsReadAsTheArm) {
  const RobotExport out =
      Of(Nothing(), {Found("presliding", 1, Eigen::Vector2d(1.5, .003)),
                     Found("backlash", 2, Eigen::Vector3d(.002, .25, .2))});
  for (const RobotFile& file : out.files) {
    if (std::string(file.format->name) != "mjcf") continue;
    const Robot robot = ReadRobot(WriteFile(file.text, "back.xml"), {});
    ASSERT_EQ(robot.num_joints(), 3);
    for (int j = 0; j < 3; ++j) {
      EXPECT_EQ(robot.links[j].joint.name, arm_.file.links[j].joint.name);
      EXPECT_NEAR(robot.links[j].joint.coulomb, j == 1 ? 5.5 : 4, .03);
      EXPECT_NEAR(robot.links[j].joint.armature,
                  arm_.file.links[j].joint.armature, 1e-12);
    }
  }
}

// The friction's mixture of widths is what a simulator with laws needs: the
// forces add up to the joint's Coulomb friction.
TEST_F(Export, JsonHasTheFrictionOfEveryJoint) {
  const RobotExport out = Of(arm_.TrueValues(arm_.Baseline(), 0), {});
  for (int j = 0; j < 3; ++j) {
    const nlohmann::json& joint = out.effects["joints"][j];
    double sum = 0, within = 0;
    for (const nlohmann::json& part : joint["coulomb"]) {
      sum += part["force"].get<double>();
      if (part["width"] == CorrectedArm::kWidth)
        within += double(part["force"]);
    }
    EXPECT_NEAR(sum, CorrectedArm::Coulomb(j), 1e-12);
    EXPECT_NEAR(within, CorrectedArm::Coulomb(j), 1e-12);
    EXPECT_NEAR(joint["viscous"], CorrectedArm::Viscous(j), 1e-12);
  }
}

// A payload is in the last link, and the file keeps the rest of its text.
TEST_F(Export, UpdatesTheRobotsOwnFile) {
  std::string text = MakeUrdf(arm_.file);
  text.insert(text.rfind("</robot>"), "<material name=\"blue\"/>");
  const std::string path = WriteFile(text, "own.urdf");
  const Effect* payload = FindEffect("payload");
  ASSERT_NE(payload, nullptr);
  VectorXd p = VectorXd::Zero(payload->parameters.size());
  p[0] = .5;
  const RobotExport out = Of(Nothing(), {Found("payload", -1, p)}, path);
  EXPECT_THAT(out.urdf, HasSubstr("<material name=\"blue\"/>"));
  EXPECT_NEAR(Read(out.urdf).links[2].inertial.mass,
              arm_.file.links[2].inertial.mass + .5, 1e-8);
  EXPECT_THAT(out.losses, Not(Contains(HasSubstr("payload"))));
}

// A link as light as nothing: its neighbours take what logs show of it.
TEST_F(Export, LinksAreTheNearestThatCanExist) {
  VectorXd x = Nothing();
  x[0] = -30;  // the first link's mass, of 5 %
  const RobotExport out = Of(x, {});
  const Robot robot = Read(out.urdf);
  const Robot fitted = arm_.Baseline().With(x);
  ASSERT_NE(WhyUnphysical(fitted.links[0].inertial), "");
  std::mt19937_64 random(2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(WhyUnphysical(robot.links[i].inertial), "");
    const VectorXd q = UniformVector(&random, 3, -1, 1);
    const VectorXd qd = UniformVector(&random, 3, -1, 1);
    const VectorXd tau = InverseDynamics(fitted, q, qd, qd);
    EXPECT_LE((InverseDynamics(robot, q, qd, qd) - tau).norm(),
              .01 * tau.norm());
  }
  EXPECT_THAT(out.losses, Contains(HasSubstr("the nearest that can")));
}

TEST_F(Export, FrictionDoesNotPush) {
  VectorXd x = Nothing();
  const GapBaseline baseline = arm_.Baseline();
  for (int c = 0; c < baseline.size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    if (column.kind == BaselineColumn::Kind::kTerm && column.joint == 1 &&
        column.index == static_cast<int>(JointTerm::kViscous)) {
      x[c] = -30;
    }
  }
  const RobotExport out = Of(x, {});
  EXPECT_EQ(Read(out.urdf).links[1].joint.viscous, 0);
  EXPECT_THAT(out.losses, Contains(HasSubstr("which cannot push")));
}

}  // namespace armcal::robot_export_test
