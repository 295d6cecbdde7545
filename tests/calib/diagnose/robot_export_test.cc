#include "calib/diagnose/robot_export.h"

#include <gmock/gmock.h>

#include <map>

#include "model/dynamics/inverse_dynamics.h"
#include "model/effects/effects.h"
#include "model/robot_files/robot_formats.h"
#include "model/robot_files/robot_reader.h"
#include "model/robot_files/urdf_reader.h"
#include "model/robot_files/urdf_writer.h"
#include "tests/fixtures/corrected_arm.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::robot_export_test {

using Eigen::VectorXd;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class Export : public testing::Test {
 protected:
  Export() {
    for (Link& link : arm_.file.links) link.joint.coulomb = 4;
    arm_.scale.torque = arm_.scale.speed = VectorXd::Ones(3);
    arm_.scale.load = arm_.scale.acceleration = VectorXd::Ones(3);
    arm_.scale.end = 10;
  }
  GapCandidate Found(const std::string& name, int joint, VectorXd p) {
    GapCandidate found;
    found.effect = FindEffect(name);
    EXPECT_NE(found.effect, nullptr) << name;
    found.joint = joint;
    found.p = std::move(p);
    return found;
  }
  RobotExport Of(const VectorXd& x, const std::vector<GapCandidate>& effects,
                 const std::string& path = "") {
    const GapBaseline baseline = arm_.Baseline();
    return ExportCorrectedRobot(
        MakeCorrectedRobot(baseline, x, effects, arm_.scale), arm_.file, path,
        "", AllFormats());
  }
  static std::vector<const RobotFormat*> AllFormats() {
    std::vector<const RobotFormat*> formats;
    for (const RobotFormat& format : RobotFormats()) formats.push_back(&format);
    return formats;
  }
  VectorXd Nothing() { return VectorXd::Zero(arm_.Baseline().size()); }
  static Robot Read(const std::string& urdf) {
    return ReadUrdf(WriteFile(urdf, "robot.urdf"), RobotReaderOptions());
  }

  CorrectedArm arm_;
};

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
  std::map<std::string, RobotFile> files;
  for (const RobotFile& file : out.files) files[file.format->name] = file;
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

// Presliding is Coulomb friction to a joint that moves on.
TEST_F(Export, LawsOfFrictionLeaveTheirShare) {
  const RobotExport out =
      Of(Nothing(), {Found("presliding", 2, Eigen::Vector2d(1.5, .003))});
  const double before = arm_.file.links[2].joint.coulomb;
  EXPECT_NEAR(Read(out.urdf).links[2].joint.coulomb, before + 1.5, 1e-6);
  EXPECT_NEAR(Read(out.urdf).links[2].joint.viscous, 3, 1e-6);
  EXPECT_THAT(out.losses, Contains(HasSubstr("of Coulomb friction 1.5 is in")));
}

// MJCF has fields for laws that others have not, and for torque that acts late.
TEST_F(Export, MjcfHoldsLawsOfDrives) {
  VectorXd x = Nothing();
  x[x.size() - 1] = -4;  // the timing's standard deviations of 0.5 ms
  const RobotExport out =
      Of(x, {Found("stribeck", 0, Eigen::Vector2d(.8, .2)),
             Found("presliding", 1, Eigen::Vector2d(1.5, .003)),
             Found("torque_ripple", 1, Eigen::Vector3d(0, -.6, 12)),
             Found("elasticity", 2, Eigen::Vector3d(1e-3, .02, 0))});
  std::map<std::string, RobotFile> files;
  for (const RobotFile& file : out.files) files[file.format->name] = file;
  const RobotFile& mjcf = files["mjcf"];
  EXPECT_THAT(mjcf.losses, Not(Contains(HasSubstr("see effects.json"))));
  EXPECT_THAT(mjcf.losses, Not(Contains(HasSubstr("the motion"))));
  EXPECT_THAT(mjcf.text,
              AllOf(HasSubstr("lugre=\"500 0 1.5 1.5 1\""),
                    HasSubstr("cogging=\"0.6 12 "), HasSubstr("_gear\""),
                    HasSubstr("delay=\"0.002\""), HasSubstr("solreffriction")));
  const RobotFile& plain = files["mjcf_plain"];
  EXPECT_THAT(plain.text, Not(HasSubstr("dcmotor")));
  EXPECT_THAT(plain.text, Not(HasSubstr("_gear")));
  for (const char* lost : {"stribeck", "presliding", "torque_ripple",
                           "elasticity", "2 ms before", "changes sign"}) {
    EXPECT_THAT(plain.losses, Contains(HasSubstr(lost)));
  }
  for (const nlohmann::json& effect : out.effects["effects"]) {
    EXPECT_THAT(effect["in"], ElementsAre("mjcf"));
  }
  EXPECT_THAT(out.effects["delay_in"], ElementsAre("mjcf"));
  // Friction's share stands in the files that have no such law.
  EXPECT_TRUE(out.effects["effects"][1].contains("share"));
}

// Read back, the motors of yielding joints are the joints, and friction is what
// a joint that moves on has of it.
TEST_F(Export, MjcfOfLawsIsReadAsTheArm) {
  const RobotExport out =
      Of(Nothing(), {Found("presliding", 1, Eigen::Vector2d(1.5, .003)),
                     Found("backlash", 2, Eigen::Vector2d(.002, .25))});
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
