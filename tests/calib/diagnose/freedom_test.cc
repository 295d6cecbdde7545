// What a file was taken for, and what the logs make of that.

#include "calib/diagnose/freedom.h"

#include <map>

#include "tests/fixtures/diagnosed_arm.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::freedom_test {

class FreedomTest : public DiagnosedArm<32> {
 protected:
  FreedomTest() { may_trust_less_ = true; }

  // A guess: each link's mass, centre and inertia wrong by other factors.
  Robot RoughFile() const {
    Robot file = File();
    InertialParameters& first = file.links[0].inertial;
    InertialParameters& second = file.links[1].inertial;
    first.inertia *= 1.5;
    first.first_moment *= 1.3;
    second.inertia *= .6;
    second.first_moment *= .7;
    return file;
  }
};

// No single effect is what is wrong with it.
TEST_F(FreedomTest, ARoughFileIsTrustedLess) {
  const GapDiagnosis diagnosis = Diagnose(RoughFile());
  EXPECT_GT(diagnosis.trust, .05);
  EXPECT_TRUE(diagnosis.effects.empty());
}

TEST_F(FreedomTest, AGoodFileIsTrustedAsBefore) {
  EXPECT_EQ(Diagnose(File()).trust, .05);
}

// One column for what is there costs less than freedom for all links, which
// would not explain it either.
TEST_F(FreedomTest, ASpringIsNoRoughFile) {
  Add("spring", 1, {12, 3});
  const GapDiagnosis diagnosis = Diagnose(File());
  EXPECT_EQ(diagnosis.trust, .05);
  ExpectFirst(diagnosis, "spring", 1);
}

TEST_F(FreedomTest, WhatTheUserSaysStands) {
  may_trust_less_ = false;
  EXPECT_EQ(Diagnose(RoughFile()).trust, .05);
}

// The file gives no armature, and a first link that is heavier than the true
// one: torques ask for less inertia than that, which no motor has.
TEST_F(FreedomTest, NoMotorHasNegativeInertia) {
  may_trust_less_ = false;
  Robot file = File();
  for (Link& link : file.links) link.joint.armature = 0;
  file.links[0].inertial.inertia *= 8;
  const GapDiagnosis diagnosis = Diagnose(file);
  const auto armature = std::find_if(
      diagnosis.effects.begin(), diagnosis.effects.end(),
      [](const FoundEffect& f) { return f.effect->name == "armature"; });
  ASSERT_NE(armature, diagnosis.effects.end());
  ASSERT_EQ(armature->estimates.size(), 1u);
  ExpectEstimate(*armature, File().links[1].joint.name + ".armature", .2, .3);
}

// Six joints with the friction of gears, of which the file has a placeholder.
class OtherFriction : public testing::Test {
 protected:
  static constexpr double kViscous = 8, kCoulomb = 5, kArmature = .4;
  static constexpr CoulombTransition kTransition = {
      CoulombTransition::Law::kVelocity, .008};

  OtherFriction() {
    SetRandomInertials(&random_, &file_);
    for (Link& link : file_.links) {
      link.joint.viscous = .1;
      link.joint.coulomb = .05;
      link.joint.armature = 0;
    }
  }

  // Torques of the file's links and of these terms on all joints; viscous
  // friction of the second so many times as large.
  LogSet Record(double viscous, double coulomb, double armature,
                const std::string& name, double on_second = 1) {
    Robot robot = file_;
    for (Link& link : robot.links) {
      link.joint.viscous = viscous;
      link.joint.armature = armature;
    }
    robot.links[1].joint.viscous *= on_second;
    if (load_ > 0) robot = WithLoad(robot);
    for (int j = 0; j < 6; ++j) robot.links[j].joint.viscous *= OfTheDay(j);
    Log log = RecordMotion(RandomMultisine(&random_, 6, 1.2), 30, .004);
    AddTorque(robot, &log);
    for (int j = 0; j < 6; ++j)
      AddCoulomb(j, coulomb / OfTheDay(j), kTransition, &log);
    AddNoise(&random_, .005 * ColumnRms(log.tau), &log.tau);
    LogReaderOptions reader;
    reader.joint_names = file_.JointNames();
    return LogSet({WriteFile(LogCsv(log), name)}, reader, {});
  }

  // A few cm beside the tool's frame.
  Robot WithLoad(const Robot& robot) const {
    Eigen::VectorXd load(5);
    load << load_, load_ * Eigen::Vector3d(.05, .02, .05), 0;
    SimulatedRobot loaded;
    loaded.robot = robot;
    FindEffect("payload")->apply({&robot, -1, nullptr}, load, &loaded);
    return loaded.robot;
  }

  // By which a joint has more viscous friction and less Coulomb friction.
  double OfTheDay(int joint) const { return joint % 2 == 0 ? 1 / day_ : day_; }

  GapDiagnosis Diagnose(const LogSet& log, const LogSet* reference) const {
    DiagnosisOptions options;
    options.forward = false;
    if (reference != nullptr) options.baseline.trust = .5;
    return DiagnoseGap(file_, options, log, nullptr, reference);
  }

  // As terms of all joints, and as nothing else.
  static void ExpectGears(const GapDiagnosis& diagnosis) {
    const std::map<std::string, double> truth = {
        {"viscous", kViscous}, {"coulomb", kCoulomb}, {"armature", kArmature}};
    size_t found = 0;
    for (const FoundEffect& effect : diagnosis.effects) {
      EXPECT_TRUE(effect.missing_term) << effect.effect->name;
      for (size_t k = 0; k < effect.estimates.size(); ++k) {
        const EffectEstimate& estimate = effect.estimates[k];
        const std::string term =
            estimate.name.substr(estimate.name.find('.') + 1);
        ASSERT_EQ(truth.count(term), 1u) << estimate.name;
        EXPECT_NEAR(estimate.value, truth.at(term),
                    4 * effect.stddev[k] + .02 * truth.at(term))
            << estimate.name << " +- " << effect.stddev[k];
        ++found;
      }
    }
    EXPECT_GE(found, 17u);  // of 18; an armature may not be told
    ASSERT_FALSE(diagnosis.ladder.terms.empty());
    const Eigen::VectorXd& left = diagnosis.ladder.terms.back().left;
    for (int j = 0; j < 6; ++j) {
      EXPECT_LT(left[j], .1 * diagnosis.ladder.without[j]) << j;
    }
  }

  double load_ = 0;  // kg
  double day_ = 1;
  std::mt19937_64 random_{1};
  Robot file_ = SampleRobot("UR5 6R");
};

TEST_F(OtherFriction, PlaceholdersOfTheFileAreNotBelieved) {
  const LogSet log = Record(kViscous, kCoulomb, kArmature, "log.csv");
  const GapDiagnosis diagnosis = Diagnose(log, nullptr);
  ExpectGears(diagnosis);
  EXPECT_EQ(diagnosis.ladder.terms.size(), 3u);
}

// Behind the gears a joint torque sensor has none of their friction, which the
// motor's torque has.
TEST_F(OtherFriction, OfAReferenceTellsOfTheLinksAlone) {
  const LogSet log = Record(kViscous, kCoulomb, kArmature, "motors.csv");
  const LogSet reference = Record(.3, .2, 0, "sensors.csv");
  const GapDiagnosis diagnosis = Diagnose(log, &reference);
  ExpectGears(diagnosis);
  EXPECT_FALSE(diagnosis.has_reference);
  EXPECT_FALSE(diagnosis.not_of_reference.empty());
  ASSERT_FALSE(diagnosis.data.empty());
  EXPECT_TRUE(diagnosis.data[0].leads);
}

// Cold gears have half as much friction again on all joints, which a load does
// not make another robot's.
TEST_F(OtherFriction, OfAColdDayIsTheReferences) {
  const LogSet reference = Record(kViscous, kCoulomb, kArmature, "warm.csv");
  const LogSet log =
      Record(1.6 * kViscous, 1.5 * kCoulomb, kArmature, "cold.csv");
  const GapDiagnosis diagnosis = Diagnose(log, &reference);
  EXPECT_TRUE(diagnosis.has_reference);
  EXPECT_TRUE(diagnosis.not_of_reference.empty());
}

// Friction that is a tenth off on each joint, one way or the other, is that of
// another day, also where a load comes with it.
TEST_F(OtherFriction, OfALoadOnAnotherDayIsTheReferences) {
  for (Link& link : file_.links) {
    link.joint.viscous = kViscous;
    link.joint.coulomb = kCoulomb;
    link.joint.armature = kArmature;
  }
  const LogSet reference = Record(kViscous, kCoulomb, kArmature, "before.csv");
  load_ = 1;
  day_ = 1.1;
  const LogSet log = Record(kViscous, kCoulomb, kArmature, "loaded.csv");
  const GapDiagnosis diagnosis = Diagnose(log, &reference);
  EXPECT_TRUE(diagnosis.has_reference);
  EXPECT_TRUE(diagnosis.not_of_reference.empty());
  const auto payload = std::find_if(
      diagnosis.effects.begin(), diagnosis.effects.end(),
      [](const auto& one) { return one.effect->name == "payload"; });
  ASSERT_NE(payload, diagnosis.effects.end());
  ExpectEstimate(*payload, "mass", load_, .05);
}

// One joint's friction is an effect, and the reference one still.
TEST_F(OtherFriction, OfOneJointIsAnEffect) {
  const LogSet reference = Record(kViscous, kCoulomb, kArmature, "before.csv");
  const LogSet log = Record(kViscous, kCoulomb, kArmature, "after.csv", 2);
  const GapDiagnosis diagnosis = Diagnose(log, &reference);
  EXPECT_TRUE(diagnosis.has_reference);
  EXPECT_TRUE(diagnosis.not_of_reference.empty());
  const auto viscous = std::find_if(
      diagnosis.effects.begin(), diagnosis.effects.end(), [](const auto& one) {
        return one.effect->name == "viscous_friction" && one.joint == 1;
      });
  ASSERT_NE(viscous, diagnosis.effects.end());
  ExpectEstimate(*viscous, "viscous", kViscous, .2);
}

}  // namespace armcal::freedom_test
