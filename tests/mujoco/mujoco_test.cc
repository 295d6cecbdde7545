// Robot files for simulators in MuJoCo: a referee that shares no code. Built
// where find_package(mujoco) finds it.

#include <gtest/gtest.h>

#include <filesystem>

#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/nonlinear_runs.h"
#include "tests/mujoco/calibrated_robot.h"
#include "tests/mujoco/mujoco_model.h"

namespace armcal::mujoco_test {

using Eigen::VectorXd;

const std::string kData = SHARED_DIR "/data/";

// Both predict the same torques of the rigid arm, to 1e-6, at 100 states.
// What MuJoCo adds to it is taken away: friction, armature, limits, contacts.
void ExpectSameInMujoco(const Robot& robot) {
  const MujocoModel model = LoadInMujoco(robot);
  ASSERT_NE(model, nullptr);
  const MujocoJoints joints(robot, *model);
  const int n = robot.num_joints();
  ASSERT_EQ(joints.v.size(), n);
  for (int j = 0; j < n; ++j) {
    const Joint& joint = robot.links[j].joint;
    EXPECT_NEAR(model->dof_damping[joints.v[j]], joint.viscous, 1e-8);
    EXPECT_NEAR(model->dof_frictionloss[joints.v[j]], joint.coulomb, 1e-8);
  }
  mju_zero(model->dof_damping, n);
  mju_zero(model->dof_frictionloss, n);
  mju_zero(model->dof_armature, n);
  model->opt.disableflags |= mjDSBL_CONSTRAINT;
  const MujocoData data(mj_makeData(model.get()), mj_deleteData);
  std::mt19937_64 random(3);
  for (int k = 0; k < 100; ++k) {
    const VectorXd q = UniformVector(&random, n, -3, 3);
    const VectorXd qd = UniformVector(&random, n, -2, 2);
    const VectorXd qdd = UniformVector(&random, n, -5, 5);
    joints.SetMotion(q, qd, qdd, data.get());
    mj_inverse(model.get(), data.get());
    const VectorXd tau = joints.Read(data->qfrc_inverse);
    const VectorXd ours = InverseDynamics(robot, q, qd, qdd);
    EXPECT_LE((tau - ours).norm(), 1e-6 * ours.norm());
  }
}

TEST(Mujoco, Ur10e) {
  if (!std::filesystem::exists(kData + "ur10e_free")) {
    GTEST_SKIP() << "shared/data/ur10e_free is not here";
  }
  ExpectSameInMujoco(CalibratedUr10e());
}

TEST(Mujoco, Panda) {
  if (!std::filesystem::exists(kData + "panda")) {
    GTEST_SKIP() << "shared/data/panda is not here";
  }
  ExpectSameInMujoco(CalibratedRobot("panda/", "log.csv", 8, {}));
}

TEST(Mujoco, SimulatedArmsAfterCalibration) {
  for (const char* name : {"UR5 6R", "Panda 7R", "SCARA RRPR"}) {
    std::mt19937_64 random(4);
    const SimulatedArm arm = MakeArm(name, .3, &random);
    const auto result = Calibrate(arm, .01, {}, &random).physical;
    ASSERT_TRUE(result.solved) << name;
    ExpectSameInMujoco(result.robot);
  }
}

// Truth far from the file: links at the boundary of what can exist, which
// MuJoCo refuses beyond.
TEST(Mujoco, LinksAtTheBoundaryLoad) {
  for (int seed = 1; seed <= 5; ++seed) {
    std::mt19937_64 random(seed);
    const SimulatedArm arm = MakeArm("Panda 7R", 1, &random);
    NonlinearCalibrationOptions options;
    options.trust.inertia = 3;
    const auto result = Calibrate(arm, .1, options, &random).physical;
    ASSERT_TRUE(result.solved);
    ExpectSameInMujoco(result.robot);
  }
}

}  // namespace armcal::mujoco_test
