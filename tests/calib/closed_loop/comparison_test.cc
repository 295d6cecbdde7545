#include "calib/closed_loop/comparison.h"

#include <gmock/gmock.h>

#include <cmath>

#include "model/log_files/log_writer.h"
#include "model/plant/closed_loop.h"
#include "model/plant/simbody_arm.h"
#include "model/text/input_error.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::comparison_test {

using testing::HasSubstr;

// A 3R arm with viscous friction, moved by a controller whose robot file knows
// of none.
class CommandedArm : public testing::Test {
 protected:
  CommandedArm() : file_(SampleRobot("3R elbow")) {
    std::mt19937_64 random(5);
    SetRandomInertials(&random, &file_);
    for (Link& link : file_.links) link.joint.armature = .3;
    truth_ = file_;
    SimulatedRobot plant;
    for (int j = 0; j < 3; ++j) {
      truth_.links[j].joint.viscous = 2 + j;
      plant.joint_laws.push_back(
          {j, {}, false, [j](const ArmInstant& at, const double*, double*) {
             return -(2 + j) * at.velocity[j];
           }});
    }
    plant.robot = truth_;
    MotionOptions motion;
    motion.duration = 6;
    const ReferenceMotion reference = FourierMotion(file_, motion);
    ClosedLoopOptions loop;
    loop.controller = controller_ =
        DefaultController(file_, reference.at(0).q, 8);
    SimbodyArm arm(truth_);
    path_ = WriteFile(
        LogText(RunClosedLoop(plant, file_, reference, loop, &arm).log));
    options_.joint_names = file_.JointNames();
  }

  Robot file_, truth_;
  ControllerOptions controller_;
  std::string path_;
  LogReaderOptions options_;
};

// With the friction the loop follows the log, in position and, ten times nearer
// than without, in torque: a command of 250 Hz has been differenced twice.
TEST_F(CommandedArm, TheTruthFollowsTheLog) {
  const CommandedLog log = ReadCommandedLog(path_, options_, {});
  CalibratedRobot calibrated;
  calibrated.robot = truth_;
  calibrated.transitions.resize(3);
  const ClosedLoopComparison loop =
      CompareClosedLoop(file_, &calibrated, controller_, log);
  EXPECT_TRUE(loop.before_finite && loop.after_finite);
  ASSERT_EQ(loop.joints.size(), 3u);
  for (const ClosedLoopJoint& joint : loop.joints) {
    EXPECT_LT(joint.after_rms, 1e-6) << joint.name;
    EXPECT_GT(joint.before_rms, 3e-5) << joint.name;
    EXPECT_LT(joint.after_torque_rms, 5e-3 * joint.torque_rms) << joint.name;
    EXPECT_GT(joint.before_torque_rms, .05 * joint.torque_rms) << joint.name;
  }
  const ClosedLoopComparison file =
      CompareClosedLoop(file_, nullptr, controller_, log);
  EXPECT_TRUE(std::isnan(file.joints[0].after_rms));
  EXPECT_EQ(file.joints[0].before_rms, loop.joints[0].before_rms);
}

TEST_F(CommandedArm, CropStartsItsOwnTime) {
  const Log log = ReadCommandedLog(path_, options_, {2, 5}).log;
  EXPECT_EQ(log.t[0], 0);
  EXPECT_NEAR(log.t[log.size() - 1], 3, .01);
  EXPECT_THAT(
      MessageOf<InputError>(path_,
                            [&] {
                              ReadCommandedLog(path_, options_, {2, 2.5});
                            }),
      HasSubstr("FILE: expected more than a second"));
}

// A log that ends between two control periods, the nearer of which is after its
// end; and one whose end is a rounding error before a period.
TEST_F(CommandedArm, MayEndBetweenControlPeriods) {
  for (const double end : {3.4997, 3.4992, std::nextafter(3.5, 0)}) {
    CommandedLog log = ReadCommandedLog(path_, options_, {2, 5.5});
    Eigen::VectorXd& t = log.log.t;
    t *= end / t[t.size() - 1];
    t[t.size() - 1] = end;
    const ClosedLoopComparison loop =
        CompareClosedLoop(file_, nullptr, controller_, log);
    EXPECT_TRUE(loop.before_finite);
    for (const ClosedLoopJoint& joint : loop.joints) {
      EXPECT_LT(joint.before_rms, 1e-2) << joint.name << " " << end;
    }
  }
}

// Without its torques the same positions come.
TEST_F(CommandedArm, FollowsALogOfPositionsAlone) {
  CommandedLog log = ReadCommandedLog(path_, options_, {});
  const ClosedLoopComparison with =
      CompareClosedLoop(file_, nullptr, controller_, log);
  log.log.tau.resize(0, 0);
  const ClosedLoopComparison without =
      CompareClosedLoop(file_, nullptr, controller_, log);
  EXPECT_EQ(without.joints[1].before_rms, with.joints[1].before_rms);
  EXPECT_TRUE(std::isnan(without.joints[1].before_torque_rms));
  EXPECT_TRUE(std::isnan(without.joints[1].torque_rms));
}

TEST_F(CommandedArm, TooManyRowsAreRefusedNotCut) {
  std::string text = "t,q1,tau1,qref1\n";
  for (int k = 0; k <= 1 << 20; ++k) text += std::to_string(k) + ",0,0,0\n";
  const std::string path = WriteFile(text, "long.csv");
  options_.joint_names.resize(1);
  EXPECT_THAT(MessageOf<InputError>(
                  path, [&] { ReadCommandedLog(path, options_, {}); }),
              HasSubstr("FILE: row 1048578: expected a log of at most 1048576 "
                        "rows"));
}

TEST_F(CommandedArm, WithoutACommandItIsRefused) {
  const std::string path =
      WriteFile("t,q1,tau1,q2,tau2,q3,tau3\n0,0,0,0,0,0,0\n", "plain.csv");
  EXPECT_THAT(MessageOf<InputError>(
                  path, [&] { ReadCommandedLog(path, options_, {}); }),
              HasSubstr("FILE: header: expected a column qref1.."));
}

}  // namespace armcal::comparison_test
