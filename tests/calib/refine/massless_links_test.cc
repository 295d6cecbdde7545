// A body with two joints, as MJCF has them: armcal puts a link without mass
// between them, about which nothing is to be estimated.

#include <gtest/gtest.h>

#include "calib/refine/nonlinear_calibration.h"
#include "calib/refine/nonlinear_report.h"
#include "calib/refine/robot_draws.h"
#include "model/robot_files/mjcf/mjcf_reader.h"
#include "tests/fixtures/nonlinear_runs.h"

namespace armcal::massless_links_test {

using Eigen::VectorXd;

// Joints b1 and b2 move body "b", which an arm carries.
const char kFile[] =
    "<mujoco><option gravity='0 0 -9.81'/><worldbody><body name='a' "
    "pos='0 0 .2'><joint name='a1' axis='0 1 .2'/><inertial pos='.1 .02 .1' "
    "mass='3' diaginertia='.04 .05 .03'/><body name='b' pos='.3 0 .1'><joint "
    "name='b1' axis='0 1 0'/><joint name='b2' axis='1 0 .1' pos='.02 .01 .05'/>"
    "<inertial pos='.1 .04 .1' mass='2' diaginertia='.02 .03 .025'/></body>"
    "</body></worldbody></mujoco>";

SimulatedArm TwoJointArm(std::mt19937_64* random) {
  SimulatedArm arm{ReadMjcf({"arm.xml", kFile}, {}), {}};
  arm.truth = arm.file;
  for (Link& link : arm.truth.links) {
    if (link.has_inertial) {
      link.inertial = DrawAround(link.inertial, .3, random);
    }
    link.joint.viscous = Uniform(random, .5, 2);
    link.joint.coulomb = Uniform(random, .5, 2);
    link.joint.armature = Uniform(random, .1, .5);
  }
  return arm;
}

class MasslessLinks : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937_64 random(21);
    arm_ = TwoJointArm(&random);
    run_.emplace(Calibrate(arm_, .01, {}, &random));
    ASSERT_TRUE(run_->physical.solved) << run_->physical.reason;
  }
  SimulatedArm arm_;
  std::optional<NonlinearRun> run_;
};

TEST_F(MasslessLinks, AreHeldAndTheBodyHasAll) {
  const NonlinearCalibration& found = run_->physical;
  EXPECT_EQ(found.reason, "CONVERGENCE");
  const std::vector<Link>& links = found.robot.links;
  ASSERT_EQ(links[1].name, "b_b1");
  EXPECT_TRUE(links[1].inertial.ToVector().isZero(0));
  EXPECT_FALSE(links[1].has_inertial);
  EXPECT_TRUE(IsDeclaredMassless(links[1]));
  for (const int i : {0, 2}) {
    EXPECT_EQ(WhyUnphysical(links[i].inertial), "") << links[i].name;
  }
  for (const PhysicalParameter& p : found.parameters) {
    if (p.name.rfind("b_b1.", 0) == 0) {
      EXPECT_TRUE(p.held && p.value == 0) << p.name;
    }
    // Of all mass beyond the joint b1 the logs tell the first moment.
    if (p.name != "b.hx" && p.name != "b.hy") continue;
    EXPECT_TRUE(p.identifiable) << p.name;
    EXPECT_LE(std::abs(p.value - ValueIn(arm_.truth, p.name)), 4 * p.stddev)
        << p.name;
  }
  EXPECT_NE(NonlinearReport(arm_.file, found).find("b_b1"), std::string::npos);
}

// By a referee: errors below half of the logs' noise.
TEST_F(MasslessLinks, TheRobotPredictsNewMotion) {
  std::mt19937_64 same(77), motion(77);
  const Log predicted = MoveArm(run_->physical.robot, 10, &same);
  const Log truth = MoveArm(arm_.truth, 10, &motion);
  const VectorXd error = ColumnRms(predicted.tau - truth.tau);
  const VectorXd noise = .01 * ColumnRms(truth.tau);
  for (int j = 0; j < error.size(); ++j) {
    EXPECT_LE(error[j], .5 * noise[j]) << "joint " << j + 1;
  }
}

TEST_F(MasslessLinks, DrawnRobotsHaveThemToo) {
  for (const Robot& robot : DrawRobots(run_->physical, 5).robots) {
    EXPECT_TRUE(robot.links[1].inertial.ToVector().isZero(0));
    EXPECT_EQ(WhyUnphysical(robot.links[0].inertial), "");
    EXPECT_EQ(WhyUnphysical(robot.links[2].inertial), "");
  }
}

}  // namespace armcal::massless_links_test
