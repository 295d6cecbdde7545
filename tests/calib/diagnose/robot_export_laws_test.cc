// Laws in the files of corrected robots: in fields of their own, or what stands
// in their stead.

#include "tests/calib/diagnose/corrected_export.h"

namespace armcal::robot_export_laws_test {

using Eigen::VectorXd;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

using LawsInFiles = CorrectedExport;

// Files without a law have what stands in its stead, and say so; those that
// have the law have nothing beside it.
TEST_F(LawsInFiles, LawsLeaveTheirShare) {
  CorrectedRobot corrected = Corrected(
      Nothing(), {Found("presliding", 2, Eigen::Vector2d(1.6, .003))});
  corrected.effects[0].share = Eigen::Vector2d(-.2, 1.5);
  const RobotExport out = Of(corrected);
  const Joint& before = arm_.file.links[2].joint;
  const std::string sentence =
      "the mean of presliding over the log is in joint " + before.name +
      " of the file (viscous -0.2 N m s/rad, coulomb 1.5 N m)";
  std::map<std::string, RobotFile> files = ByFormat(out);
  for (const char* name : {"urdf", "mjcf_plain", "sdf", "yaml", "mjcf"}) {
    SCOPED_TRACE(name);
    const bool plain = std::string(name) != "mjcf";
    const RobotFile& file = files[name];
    const Robot robot = ReadRobot(WriteFile(file.text, file.format->file), {});
    EXPECT_NEAR(robot.links[2].joint.viscous, before.viscous - (plain ? .2 : 0),
                1e-6);
    EXPECT_NEAR(robot.links[2].joint.coulomb,
                before.coulomb + (plain ? 1.5 : 1.6), 1e-6);
    if (!plain) continue;
    EXPECT_THAT(file.text, HasSubstr("armcal: " + sentence));
    EXPECT_THAT(file.losses, Contains(HasSubstr(sentence)));
  }
  EXPECT_THAT(out.urdf, HasSubstr("<!-- armcal: " + sentence + " -->"));
  EXPECT_THAT(files["isaac"].text, HasSubstr("# armcal: " + sentence));
  EXPECT_THAT(files["mjcf"].text, Not(HasSubstr("armcal:")));
  const nlohmann::json& share = out.effects["effects"][0]["share"];
  EXPECT_EQ(share["viscous"], -.2);
  EXPECT_EQ(share["coulomb"], 1.5);
  EXPECT_EQ(share["offset"], 0);
}

// No file has a field for friction that warmth changes, MJCF neither; a
// constant torque is where there is a field for it.
TEST_F(LawsInFiles, WhatNoFormatHasIsItsMeanInAll) {
  CorrectedRobot corrected = Corrected(
      Nothing(), {Found("thermal_friction", 1, Eigen::Vector3d(.02, .01, 60)),
                  Found("time_drift", 0, Eigen::Vector2d(.5, 100))});
  corrected.effects[0].share = Eigen::Vector2d(-.9, -.7);
  corrected.effects[1].share = VectorXd::Constant(1, .25);
  std::map<std::string, RobotFile> files = ByFormat(Of(corrected));
  for (const char* name : {"urdf", "mjcf", "mjcf_plain", "sdf", "yaml"}) {
    SCOPED_TRACE(name);
    const RobotFile& file = files[name];
    const Robot robot = ReadRobot(WriteFile(file.text, file.format->file), {});
    EXPECT_NEAR(robot.links[1].joint.viscous, 3 - .9, 1e-6);
    EXPECT_NEAR(robot.links[1].joint.coulomb, 4 - .7, .02);
    const bool offset = file.format->Holds(RobotField::kOffset);
    EXPECT_NEAR(robot.links[0].joint.offset, offset ? .25 : 0, 1e-9);
    EXPECT_EQ(file.text.find("mean of time_drift") != std::string::npos,
              offset);
  }
}

// What a fit leaves of the timing where nothing is late is in no file.
TEST_F(LawsInFiles, ADelayIsWrittenWhereItIsClear) {
  const auto of = [&](double timing, const std::vector<GapCandidate>& effects) {
    VectorXd x = Nothing();
    x[x.size() - 1] = timing / 5e-4;
    return Of(x, effects);
  };
  const RobotExport rest = of(-6e-4, {}), clear = of(-2e-3, {});
  const RobotExport named =
      of(-2e-4, {Found("delay", -1, VectorXd::Constant(1, 4e-4))});
  EXPECT_THAT(ByFormat(rest)["mjcf"].text, Not(HasSubstr("delay=")));
  EXPECT_THAT(rest.losses, Not(Contains(HasSubstr("the motion"))));
  EXPECT_THAT(rest.effects["delay_in"], ElementsAre());
  EXPECT_NEAR(rest.effects["delay_s"], -6e-4, 1e-12);
  EXPECT_THAT(ByFormat(clear)["mjcf"].text, HasSubstr("delay=\"0.002\""));
  EXPECT_THAT(clear.losses, Contains(HasSubstr("2 ms before the motion")));
  EXPECT_THAT(named.effects["delay_in"], ElementsAre("mjcf"));
}

// MJCF has fields for laws that others have not, and for torque that acts late.
TEST_F(LawsInFiles, MjcfHoldsLawsOfDrives) {
  VectorXd x = Nothing();
  x[x.size() - 1] = -4;  // the timing's standard deviations of 0.5 ms
  const RobotExport out =
      Of(x, {Found("stribeck", 0, Eigen::Vector2d(.8, .2)),
             Found("presliding", 1, Eigen::Vector2d(1.5, .003)),
             Found("torque_ripple", 1, Eigen::Vector3d(0, -.6, 12)),
             Found("cable", 1, Eigen::Vector3d(2, .3, .25)),
             Found("elasticity", 2, Eigen::Vector3d(1e-3, .02, 0))});
  std::map<std::string, RobotFile> files = ByFormat(out);
  const RobotFile& mjcf = files["mjcf"];
  EXPECT_THAT(mjcf.losses, Not(Contains(HasSubstr("see effects.json"))));
  EXPECT_THAT(mjcf.losses, Not(Contains(HasSubstr("the motion"))));
  EXPECT_THAT(mjcf.text,
              AllOf(HasSubstr("lugre=\"500 0 1.5 1.5 1\""),
                    HasSubstr("cogging=\"0.6 12 "), HasSubstr("_gear\""),
                    HasSubstr("delay=\"0.002\""), HasSubstr("solreffriction"),
                    HasSubstr("_push\""), HasSubstr("springlength")));
  // Of a Stribeck curve armcal reads what is left of it in fast motion.
  const Robot back = ReadRobot(WriteFile(mjcf.text, "laws.xml"), {});
  EXPECT_NEAR(back.links[0].joint.coulomb, arm_.file.links[0].joint.coulomb,
              1e-9);
  const RobotFile& plain = files["mjcf_plain"];
  EXPECT_THAT(plain.text, Not(HasSubstr("dcmotor")));
  EXPECT_THAT(plain.text, Not(HasSubstr("_gear")));
  for (const char* lost : {"stribeck", "presliding", "torque_ripple", "cable",
                           "elasticity", "2 ms before", "changes sign"}) {
    EXPECT_THAT(plain.losses, Contains(HasSubstr(lost)));
  }
  for (const nlohmann::json& effect : out.effects["effects"]) {
    EXPECT_THAT(effect["in"], ElementsAre("mjcf"));
  }
  EXPECT_THAT(out.effects["delay_in"], ElementsAre("mjcf"));
}

}  // namespace armcal::robot_export_laws_test
