#include "calib/refine/calibration_reader.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration_report.h"
#include "calib/refine/nonlinear_report.h"
#include "model/text/input_error.h"
#include "tests/calib/refine/bent_arm.h"
#include "tests/fixtures/same_robot.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::calibration_reader_test {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

struct Written {
  Robot file;       // that was calibrated
  Robot estimated;  // what it became
  json calibration;
};

Written CalibrateAndWrite(BentArm* arm, GeometryKnowledge geometry,
                          RefineGeometry refine, const PoseMeasurements* poses,
                          const std::vector<JointTerm>& terms =
                              LinearCalibrationOptions().joint_terms) {
  arm->file.name = "arm";
  LogReaderOptions reader;
  reader.joint_names = arm->file.JointNames();
  LogSet training({arm->Record(20)}, reader, {});
  LinearCalibrationOptions linear;
  linear.geometry = geometry;
  linear.transition = BentArm::kWidth;
  linear.joint_terms = terms;
  const LinearCalibration start =
      CalibrateLinear(arm->file, linear, training, nullptr);
  NonlinearCalibrationOptions options;
  options.refine = refine;
  const NonlinearCalibration result =
      CalibrateNonlinear(arm->file, start, options, training, nullptr, poses);
  EXPECT_TRUE(result.solved) << result.reason;
  json calibration = ToJson(arm->file, training, nullptr, start);
  AddRefined(result, &calibration);
  return {arm->file, result.robot, calibration};
}

CalibratedRobot Read(const Written& written) {
  return ReadCalibration(
      WriteFile(written.calibration.dump(2), "calibration.json"), written.file);
}

// All that a simulation needs comes back: ExpectSameRobot lets armature, offset
// and gravity differ.
void ExpectReadBack(const Written& written) {
  const Robot robot = Read(written).robot;
  ExpectSameRobot(written.estimated, robot);
  EXPECT_LT((robot.gravity - written.estimated.gravity).norm(), 1e-9);
  for (int i = 0; i < robot.num_joints(); ++i) {
    const Joint& a = robot.links[i].joint;
    const Joint& b = written.estimated.links[i].joint;
    EXPECT_EQ(a.armature, b.armature);
    EXPECT_EQ(a.offset, b.offset);
  }
}

TEST(ReadCalibration, DynamicsComeBack) {
  BentArm arm("3R elbow", 1);
  const Written written = CalibrateAndWrite(&arm, GeometryKnowledge::kKnown,
                                            RefineGeometry::kNothing, nullptr);
  ExpectReadBack(written);
  const CalibratedRobot read = Read(written);
  EXPECT_TRUE(read.converged);
  EXPECT_GT(read.bandwidth_hz, 1);
  ASSERT_EQ(read.transitions.size(), 3u);
  EXPECT_EQ(read.transitions[1].law, BentArm::kWidth.law);
  EXPECT_EQ(read.transitions[1].width, BentArm::kWidth.width);
  EXPECT_TRUE(read.Saw(read.logs[0], {3, 5}));
  EXPECT_FALSE(read.Saw(read.logs[0], {25, 30}));
  EXPECT_FALSE(read.Saw("other.csv", {3, 5}));
}

// The same file by another path; one that is not there, too.
TEST(CalibratedRobot, SawTheFileByWhateverPath) {
  CalibratedRobot robot;
  robot.logs = {"a.csv", "./deep/../b.csv"};
  robot.log_ranges = {{0, 10}, {0, 10}};
  EXPECT_TRUE(robot.Saw("./a.csv", {3, 5}));
  EXPECT_TRUE(robot.Saw(std::filesystem::absolute("a.csv"), {3, 5}));
  EXPECT_TRUE(robot.Saw("b.csv", {3, 5}));
  EXPECT_FALSE(robot.Saw("deep/a.csv", {3, 5}));
}

// Friction of the file that is not estimated is in the model all the same.
TEST(ReadCalibration, FrictionOfTheFileComesBack) {
  BentArm arm("3R elbow", 1);
  for (Link& link : arm.file.links) link.joint.coulomb = .1;
  const Written written = CalibrateAndWrite(&arm, GeometryKnowledge::kKnown,
                                            RefineGeometry::kNothing, nullptr,
                                            {JointTerm::kViscous});
  const CalibratedRobot read = Read(written);
  EXPECT_EQ(read.robot.links[0].joint.coulomb, .1);
  EXPECT_EQ(read.transitions[0].width, CoulombTransition().width);
}

TEST(ReadCalibration, RefinedGeometryAndTiltComeBack) {
  BentArm arm("3R elbow", 2);
  const PoseMeasurements poses = arm.Measure(Instrument::kTargets, 40, 5e-5);
  const Written written = CalibrateAndWrite(&arm, GeometryKnowledge::kKnown,
                                            RefineGeometry::kAll, &poses);
  EXPECT_GT((written.estimated.gravity - written.file.gravity).norm(), 1e-4);
  ExpectReadBack(written);
}

TEST(ReadCalibration, RecoveredLengthsComeBack) {
  BentArm arm("3R elbow", 3);
  for (Link& link : arm.file.links) link.X_ML.translation() *= 1.08;
  const Written written =
      CalibrateAndWrite(&arm, GeometryKnowledge::kNonzeroLengths,
                        RefineGeometry::kNothing, nullptr);
  ASSERT_FALSE(written.calibration["geometry"].empty());
  ExpectReadBack(written);
}

// Each change of a good file is refused, with the key.
class ChangedCalibration : public testing::Test {
 protected:
  ChangedCalibration()
      : arm_("3R elbow", 4),
        good_(CalibrateAndWrite(&arm_, GeometryKnowledge::kKnown,
                                RefineGeometry::kNothing, nullptr)) {}

  std::string RefusalAfter(const std::function<void(json*)>& change) {
    json changed = good_.calibration;
    change(&changed);
    const std::string path = WriteFile(changed.dump(), "changed.json");
    return MessageOf<InputError>(path,
                                 [&] { ReadCalibration(path, good_.file); });
  }
  std::string RefusalOf(const std::string& pointer, const json& value) {
    return RefusalAfter(
        [&](json* c) { (*c)[json::json_pointer(pointer)] = value; });
  }

  BentArm arm_;
  Written good_;
};

TEST_F(ChangedCalibration, OfAnotherRobotOrKind) {
  EXPECT_EQ(RefusalAfter([](json*) {}), "");
  EXPECT_EQ(RefusalOf("/format", "armcal verification 1"),
            "FILE: key format: found '\"armcal verification 1\"': expected "
            "'armcal calibration 1', the format this version reads");
  EXPECT_THAT(RefusalOf("/robot", "ur5"),
              AllOf(HasSubstr("key robot: found '\"ur5\"'"),
                    HasSubstr("a calibration of another robot")));
  EXPECT_THAT(RefusalOf("/joints/1/name", "elbow"),
              AllOf(HasSubstr("key joints[1].name"), HasSubstr("'joint2'")));
  EXPECT_THAT(RefusalAfter([](json* c) { (*c)["joints"].erase(2); }),
              HasSubstr("expected 3 joints"));
  EXPECT_THAT(RefusalOf("/estimate", "linear"),
              HasSubstr("run armcal calibrate `estimate`=refined"));
}

// Of cameras, targets, touched points and planes, which are beside the robot.
TEST_F(ChangedCalibration, WhatIsNoRobotsIsLeft) {
  const auto refusal_with = [&](const std::string& name) {
    return RefusalAfter([&](json* c) {
      json entry = (*c)["parameters"].back();
      entry["name"] = name;
      (*c)["parameters"].push_back(entry);
    });
  };
  for (const char* name :
       {"target3.x", "point1.y", "plane2.a", "instrument1", "instrument.pitch",
        "wire.offset", "joint1.kp", "joint1.position_gain",
        "joint1.velocity_ki", "joint1.lag", "drive.delay"}) {
    EXPECT_EQ(refusal_with(name), "") << name;
  }
  for (const char* name : {"pointer.mass", "plane_1.viscous"}) {
    EXPECT_THAT(refusal_with(name), HasSubstr("expected a parameter of"))
        << name;
  }
}

TEST_F(ChangedCalibration, ParametersAndFriction) {
  EXPECT_THAT(RefusalOf("/parameters/0/prior", 77),
              AllOf(HasSubstr("key parameters[0].prior: found '77'"),
                    HasSubstr("what the robot file has for link1.mass")));
  EXPECT_THAT(RefusalOf("/parameters/0/unit", "g"),
              HasSubstr("expected 'kg', the unit of link1.mass"));
  EXPECT_THAT(RefusalOf("/parameters/3/value", nullptr),
              AllOf(HasSubstr("key parameters[3].value: found 'null'"),
                    HasSubstr("expected a finite number")));
  EXPECT_THAT(RefusalOf("/parameters/3/value", "2"),
              HasSubstr("a finite number"));
  EXPECT_THAT(RefusalOf("/parameters/0/value", -5),
              HasSubstr("expected a number of at least 0, as link1.mass is"));
  EXPECT_THAT(RefusalOf("/parameters/3/name", "link9.mass"),
              HasSubstr("expected a parameter of the robot of `robot`"));
  EXPECT_THAT(RefusalOf("/parameters/3/name", "link1.mass"),
              HasSubstr("expected every parameter only once"));
  EXPECT_THAT(RefusalAfter([](json* c) { (*c)["parameters"].erase(3); }),
              HasSubstr("key parameters: expected an entry for link1.hz"));
  EXPECT_THAT(RefusalAfter([](json* c) { c->erase("parameters"); }),
              HasSubstr("key parameters: is missing"));
  EXPECT_THAT(RefusalOf("/parameters", 3), HasSubstr("expected a list"));
  EXPECT_THAT(RefusalOf("/joints/0/coulomb_transition/width", 1e-10),
              HasSubstr("expected a width of at least 1e-09"));
  EXPECT_THAT(RefusalOf("/joints/0/coulomb_transition/law", "sign"),
              HasSubstr("expected 'velocity' or 'displacement'"));
  EXPECT_THAT(RefusalOf("/joints/0/coulomb_transition/unit", "m/s"),
              HasSubstr("expected 'rad/s'"));
  EXPECT_THAT(RefusalAfter([](json* c) {
                (*c)["joints"][1].erase("coulomb_transition");
              }),
              HasSubstr("key joints[1].coulomb_transition: is missing"));
  EXPECT_THAT(RefusalOf("/bandwidth_hz", -1),
              HasSubstr("expected a frequency"));
  EXPECT_THAT(RefusalOf("/refined/converged", 1),
              HasSubstr("expected true or false"));
  EXPECT_THAT(RefusalOf("", json::array()), HasSubstr("expected an object"));
}

TEST(ReadCalibration, TextThatIsNoJson) {
  const Robot robot = SampleRobot("3R elbow");
  for (const char* text : {"{\"format\": ", "t,q1,tau1\n0,1,2\n", "\xff\xfe"}) {
    const std::string path = WriteFile(text, "no.json");
    EXPECT_THAT(
        MessageOf<InputError>(path, [&] { ReadCalibration(path, robot); }),
        HasSubstr("FILE"))
        << text;
  }
  EXPECT_THROW(ReadCalibration("no_such_file.json", robot), InputError);
}

}  // namespace armcal::calibration_reader_test
