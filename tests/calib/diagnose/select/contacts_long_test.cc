// An arm that Simbody simulates is pushed at its tool, at rest and in motion.

#include <gmock/gmock.h>

#include <cmath>

#include "calib/diagnose/diagnosis.h"
#include "tests/fixtures/effect_plant.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::contacts_long_test {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::IsEmpty;

constexpr double kRest = 8;    // s, before and after the motion
constexpr double kNoise = .1;  // N m

class PushedArm : public testing::Test {
 protected:
  static void SetUpTestSuite() { arm_ = new EffectArm("UR5 6R"); }
  static void TearDownTestSuite() { delete arm_; }

  SimulatedRobot Bare() const {
    SimulatedRobot robot;
    robot.robot = arm_->robot;
    for (int j = 0; j < 6; ++j) {
      const Joint& joint = arm_->robot.links[j].joint;
      const CoulombTransition transition = arm_->transitions[j];
      robot.joint_laws.push_back(
          {j, {}, true, [=](const ArmInstant& at, const double*, double*) {
             return -FrictionTorque(joint, transition, at.velocity[j], 0);
           }});
    }
    return robot;
  }
  void Push(const Vector3d& force, double time, double width) {
    VectorXd p(5);
    p << force, time, width;
    FindEffect("external_contact")->apply(arm_->Site(-1), p, &pushed_);
  }
  std::string Record(const SimulatedRobot& robot, int run,
                     const std::string& name) {
    MotionOptions motion;
    motion.duration = 24;
    motion.run = run;
    const ReferenceMotion reference =
        WithStandstill(FourierMotion(arm_->robot, motion), kRest, kRest);
    ClosedLoopOptions options;
    options.sensors.log_rate_hz = EffectPlant::kLogRate;
    options.controller =
        DefaultController(arm_->robot, reference.at(0).q, kUsualBandwidthHz);
    SimbodyArm dynamics(robot.robot);
    Log log =
        RunClosedLoop(robot, arm_->robot, reference, options, &dynamics).log;
    AddNoise(&random_, VectorXd::Constant(6, kNoise), &log.tau);
    return WriteFile(LogCsv(log), name);
  }
  GapDiagnosis Diagnose() {
    LogReaderOptions reader;
    reader.joint_names = arm_->robot.JointNames();
    LogSet training({Record(pushed_, 0, "pushed.csv")}, reader, {});
    LogSet reference({Record(Bare(), 1, "free.csv")}, reader, {});
    DiagnosisOptions options;
    options.bandwidth_hz = 8;
    options.forward = false;
    return DiagnoseGap(arm_->robot, options, training, nullptr, &reference);
  }

  static const EffectArm* arm_;
  SimulatedRobot pushed_ = Bare();
  std::mt19937_64 random_{1};
};
const EffectArm* PushedArm::arm_ = nullptr;

TEST_F(PushedArm, IsFoundPushedAndHowHard) {
  const std::vector<Vector3d> forces = {{30, -40, 35}, {-45, 25, 40}};
  const std::vector<double> times = {4, 20};
  for (int k = 0; k < 2; ++k) Push(forces[k], times[k], .4);
  const GapDiagnosis diagnosis = Diagnose();
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  const FoundEffect& found = diagnosis.effects[0];
  EXPECT_EQ(found.effect->name, "external_contact");
  EXPECT_GT(found.probability, .9);
  ASSERT_EQ(found.contacts.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    const Contact& contact = found.contacts[k];
    SCOPED_TRACE(k);
    EXPECT_NEAR(contact.time, times[k], .2);
    EXPECT_LT(contact.window.begin, times[k]);
    EXPECT_GT(contact.window.end, times[k]);
    EXPECT_LT(contact.window.end - contact.window.begin, 3);
    ASSERT_TRUE(contact.force.has_value());
    const Vector3d error = contact.force->value - forces[k];
    EXPECT_LT(error.norm(), .05 * forces[k].norm())
        << contact.force->value.transpose();
  }
}

// The motor's joint alone, such as a cable that catches: no force at the tool
// does that.
TEST_F(PushedArm, IsFoundPushedOnOneJoint) {
  const std::vector<double> torques = {4, -4}, times = {13, 24};
  pushed_.joint_laws.push_back(
      {2, {}, true, [&](const ArmInstant& at, const double*, double*) {
         double torque = 0;
         for (int k = 0; k < 2; ++k) {
           torque +=
               torques[k] * std::exp(-std::pow((at.t - times[k]) / .2, 2));
         }
         return torque;
       }});
  const GapDiagnosis diagnosis = Diagnose();
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  const FoundEffect& found = diagnosis.effects[0];
  EXPECT_EQ(found.effect->name, "external_contact");
  EXPECT_GT(found.probability, .9);
  ASSERT_EQ(found.contacts.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    const Contact& contact = found.contacts[k];
    SCOPED_TRACE(k);
    EXPECT_EQ(contact.joint, 2);
    EXPECT_NEAR(contact.time, times[k], .1);
    EXPECT_NEAR(contact.torque[2], torques[k], .15 * std::abs(torques[k]));
    EXPECT_LT(contact.window.end - contact.window.begin, 1.6);
  }
}

TEST_F(PushedArm, LeftAloneHasNoContact) {
  EXPECT_THAT(Diagnose().effects, IsEmpty());
}

}  // namespace armcal::contacts_long_test
