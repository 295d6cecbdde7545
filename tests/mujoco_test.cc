// Robot files for simulators in MuJoCo: a referee that shares no code. Built
// where find_package(mujoco) finds it.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>

#include "calib/nonlinear_calibration.h"
#include "model/inverse_dynamics.h"
#include "model/robot_reader.h"
#include "model/urdf_writer.h"
#include "tests/nonlinear_runs.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

const std::string kData = SHARED_DIR "/data/";

// Both predict the same torques of the rigid arm, to 1e-6, at 100 states.
// What MuJoCo adds to it is taken away: friction, armature, limits, contacts.
void ExpectSameInMujoco(const Robot& robot) {
  const std::string path = WriteFile(MakeUrdf(robot), "mujoco.urdf");
  char error[1000] = "";
  const std::unique_ptr<mjModel, void (*)(mjModel*)> model(
      mj_loadXML(path.c_str(), nullptr, error, sizeof(error)), mj_deleteModel);
  ASSERT_NE(model, nullptr) << error;
  const int n = robot.num_joints();
  ASSERT_EQ(model->nv, n);
  std::vector<int> q_at, v_at;
  for (const Link& link : robot.links) {
    const int id =
        mj_name2id(model.get(), mjOBJ_JOINT, link.joint.name.c_str());
    ASSERT_GE(id, 0) << link.joint.name;
    q_at.push_back(model->jnt_qposadr[id]);
    v_at.push_back(model->jnt_dofadr[id]);
    EXPECT_NEAR(model->dof_damping[v_at.back()], link.joint.viscous, 1e-8);
    EXPECT_NEAR(model->dof_frictionloss[v_at.back()], link.joint.coulomb, 1e-8);
  }
  mju_zero(model->dof_damping, n);
  mju_zero(model->dof_frictionloss, n);
  mju_zero(model->dof_armature, n);
  mju_copy3(model->opt.gravity, robot.gravity.data());
  model->opt.disableflags |= mjDSBL_CONSTRAINT;
  const std::unique_ptr<mjData, void (*)(mjData*)> data(
      mj_makeData(model.get()), mj_deleteData);
  std::mt19937_64 random(3);
  for (int k = 0; k < 100; ++k) {
    const VectorXd q = UniformVector(&random, n, -3, 3);
    const VectorXd qd = UniformVector(&random, n, -2, 2);
    const VectorXd qdd = UniformVector(&random, n, -5, 5);
    for (int j = 0; j < n; ++j) {
      data->qpos[q_at[j]] = q[j];
      data->qvel[v_at[j]] = qd[j];
      data->qacc[v_at[j]] = qdd[j];
    }
    mj_inverse(model.get(), data.get());
    VectorXd tau(n);
    for (int j = 0; j < n; ++j) tau[j] = data->qfrc_inverse[v_at[j]];
    const VectorXd ours = InverseDynamics(robot, q, qd, qdd);
    EXPECT_LE((tau - ours).norm(), 1e-6 * ours.norm());
  }
}

Robot CalibratedRobot(const std::string& folder, const std::string& log,
                      double bandwidth_hz,
                      const std::vector<double>& torque_constants) {
  const Robot robot = ReadRobot(kData + folder + "robot.urdf", {});
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  reader.torque_constants = torque_constants;
  LogSet logs({kData + folder + log}, reader, {});
  LinearCalibrationOptions options;
  options.bandwidth_hz = bandwidth_hz;
  const auto linear = CalibrateLinear(robot, options, &logs, nullptr);
  return CalibrateNonlinear(robot, linear, {}, &logs, nullptr).robot;
}

TEST(Mujoco, Ur10e) {
  if (!std::filesystem::exists(kData + "ur10e_free")) {
    GTEST_SKIP() << "shared/data/ur10e_free is not here";
  }
  ExpectSameInMujoco(
      CalibratedRobot("ur10e_free/", "id_30s.csv", 6,
                      {14.87, 13.26, 11.13, 10.62, 11.03, 11.47}));
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

}  // namespace
}  // namespace armcal
