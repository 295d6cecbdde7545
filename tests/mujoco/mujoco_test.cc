// Robot files for simulators in MuJoCo: a referee that shares no code. Built
// where find_package(mujoco) finds it.

#include <gtest/gtest.h>

#include <filesystem>

#include "model/dynamics/inverse_dynamics.h"
#include "model/robot_files/urdf_update.h"
#include "tests/fixtures/nonlinear_runs.h"
#include "tests/fixtures/urdf_text.h"
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

// A wrist and a finger of 1 kg on it, both calibrated as 0.8 kg together. The
// finger is held at 0.7 rad, and is a body that moves to MuJoCo all the same.
TEST(Mujoco, AHeldFingerKeepsInertia) {
  using namespace urdf_text;
  const std::string path = WriteFile(
      "<robot name='hand'>" + LinkXml("base") + RodXml("arm") +
          RodXml("wrist") + RodXml("finger") +
          RodJointXml("ja", "base", "arm", ".2 .3 .1") +
          RodJointXml("jw", "arm", "wrist", ".1 .2 .3") +
          RodJointXml("jf", "wrist", "finger", ".2 .3 .1") + "</robot>",
      "hand.urdf");
  RobotReaderOptions options;
  options.tip = "wrist";
  options.posture = {{"jf", .7}};
  Robot robot = ReadUrdf(path, options);
  robot.links[1].inertial = InertialParameters::FromCenterOfMass(
      .8, {.1, .1, 0}, .01 * Eigen::Matrix3d::Identity());
  const MujocoModel model =
      LoadTextInMujoco(UpdateUrdf(path, robot, false), "updated.urdf");
  ASSERT_NE(model, nullptr);
  const MujocoData data(mj_makeData(model.get()), mj_deleteData);
  const int finger = mj_name2id(model.get(), mjOBJ_JOINT, "jf");
  data->qpos[model->jnt_qposadr[finger]] = .7;
  const MujocoJoints joints(robot, *model);
  std::mt19937_64 random(3);
  for (int k = 0; k < 20; ++k) {
    const VectorXd q = UniformVector(&random, 2, -3, 3);
    const VectorXd qd = UniformVector(&random, 2, -2, 2);
    const VectorXd qdd = UniformVector(&random, 2, -5, 5);
    joints.SetMotion(q, qd, qdd, data.get());
    mj_inverse(model.get(), data.get());
    const VectorXd ours = InverseDynamics(robot, q, qd, qdd);
    EXPECT_LE((joints.Read(data->qfrc_inverse) - ours).norm(),
              1e-6 * ours.norm());
  }
}

}  // namespace armcal::mujoco_test
