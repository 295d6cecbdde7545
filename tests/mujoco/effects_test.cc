// MuJoCo's rigid links with the laws of a diagnosis beside them follow a
// command as armcal's own simulation of the corrected robot does. (That modules
// in other languages do as EffectSteps:
// tests/calib/diagnose/modules/modules_test.cc.)

#include "model/effects/effects.h"

#include <gmock/gmock.h>

#include <optional>

#include "calib/diagnose/modules/effect_steps.h"
#include "model/dynamics/rigid_arm.h"
#include "model/plant/closed_loop.h"
#include "tests/calib/diagnose/modules/moved_arm.h"
#include "tests/mujoco/mujoco_model.h"

namespace armcal::mujoco_effects_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTimestep = 5e-4;  // s, of MuJoCo; the drives have 1 ms
constexpr double kSettled = 1;      // s, before the log and uncounted in it
constexpr double kDuration = 6;     // s

// Soft position drives, which see what encoders say.
ControllerOptions Drives(const CorrectedArm& arm) {
  ControllerOptions drives =
      DefaultController(arm.file, arm.Motion(1).at(0).q, 4);
  drives.feedforward = Feedforward::kNone;
  for (DriveLaw& law : drives.drives) law.ki = 0;
  return drives;
}

// Positions that encoders say at 1 kHz after kSettled.
MatrixXd InArmcal(const CorrectedArm& arm, const CorrectedRobot& robot) {
  SimulatedRobot plant = robot.plant;
  plant.torque_delay += robot.delay;
  ClosedLoopOptions options;
  options.controller = Drives(arm);
  options.sensors.log_rate_hz = 1000;
  RigidArm engine(plant.robot);
  const ClosedLoopRun run =
      RunClosedLoop(plant, arm.file, arm.Motion(kDuration), options, &engine);
  EXPECT_TRUE(run.finite);
  return run.log.q.bottomRows(run.log.q.rows() - std::lround(1e3 * kSettled));
}

// A model of the rigid links alone.
MujocoModel RigidModel(const CorrectedRobot& robot) {
  MujocoModel model = LoadInMujoco(robot.plant.robot);
  const MujocoJoints joints(robot.plant.robot, *model);
  model->opt.timestep = kTimestep;
  for (int j = 0; j < 3; ++j) {
    const int dof = joints.v[j];
    model->dof_frictionloss[dof] = model->dof_damping[dof] = 0;
    model->dof_armature[dof] = robot.plant.robot.links[j].joint.armature;
    model->jnt_limited[j] = 0;
  }
  for (const Transmission& law : robot.plant.transmissions) {
    model->dof_armature[joints.v[law.joint]] = 0;
  }
  return model;
}

MatrixXd InMujoco(const CorrectedArm& arm, const CorrectedRobot& robot) {
  const MujocoModel model = RigidModel(robot);
  MujocoData data(mj_makeData(model.get()), mj_deleteData);
  const MujocoJoints joints(robot.plant.robot, *model);
  const ReferenceMotion motion = arm.Motion(kDuration);
  const ControllerOptions options = Drives(arm);
  JointController controller(options, arm.file);
  DifferencedVelocity velocity(options);
  const VectorXd zero = VectorXd::Zero(3);
  joints.SetMotion(motion.at(0).q, zero, zero, data.get());
  mj_forward(model.get(), data.get());
  EffectSteps effects(robot, joints.Read(data->qfrc_bias));
  effects.SetTime(-kSettled);
  const long settle = std::lround(1e3 * kSettled);
  const long end = std::lround(1e3 * kDuration);
  MatrixXd q(end - settle + 1, 3);
  for (long tick = -settle; tick <= end; ++tick) {
    VectorXd commanded;
    for (int half = 0; half < 2; ++half) {
      const VectorXd qd = joints.Read(data->qvel);
      const VectorXd reading =
          effects.Sense(kTimestep, joints.Read(data->qpos), qd);
      if (half == 0) {
        if (tick >= settle) q.row(tick - settle) = reading;
        commanded = controller.Update(motion.at(std::max(0., 1e-3 * tick)),
                                      reading, velocity.Update(reading));
      }
      effects.Act(commanded);
      for (int j = 0; j < 3; ++j) {
        const int dof = joints.v[j];
        model->dof_damping[dof] = effects.damping()[j];
        data->qfrc_applied[dof] = effects.undamped()[j];
      }
      mj_step(model.get(), data.get());
    }
  }
  return q;
}

double RmsOf(const MatrixXd& x) {
  return std::sqrt(x.squaredNorm() / x.size());
}

// How far the two are apart, of what the effect changes.
double Apart(const std::string& name, int joint, VectorXd p) {
  MovedArm moved;
  const GapBaseline baseline = moved.arm.Baseline();
  const VectorXd x = moved.arm.TrueValues(baseline, 0);
  GapCandidate found;
  found.effect = FindEffect(name);
  found.joint = joint;
  found.p = std::move(p);
  const CorrectedRobot with =
      MakeCorrectedRobot(baseline, x, {found}, moved.arm.scale);
  const CorrectedRobot without =
      MakeCorrectedRobot(baseline, x, {}, moved.arm.scale);
  const MatrixXd armcal = InArmcal(moved.arm, with);
  const double apart = RmsOf(InMujoco(moved.arm, with) - armcal);
  const double changed = RmsOf(InArmcal(moved.arm, without) - armcal);
  std::printf("%s: %.1e rad of %.1e\n", name.c_str(), apart, changed);
  return apart / changed;
}

VectorXd Values(std::initializer_list<double> values) {
  VectorXd p(values.size());
  std::copy(values.begin(), values.end(), p.data());
  return p;
}

TEST(EffectsInMujoco, FrictionFollowsArmcal) {
  EXPECT_LT(Apart("stribeck", 1, Values({4, .15})), .05);
  EXPECT_LT(Apart("presliding", 1, Values({6, .02})), .05);
  EXPECT_LT(Apart("load_friction", 1, Values({.2})), .05);
  EXPECT_LT(Apart("thermal_friction", 1, Values({.03, .03, 2})), .05);
  EXPECT_LT(Apart("viscous_friction_of_all_joints", -1, Values({.5})), .05);
  EXPECT_LT(Apart("coupled_friction", 1, Values({5, 2, 3, .7, .02})), .05);
}

TEST(EffectsInMujoco, TorquesFollowArmcal) {
  EXPECT_LT(Apart("torque_ripple", 1, Values({3, 2, 15})), .05);
  EXPECT_LT(Apart("torque_deadband", 1, Values({3, .5})), .05);
  EXPECT_LT(Apart("encoder_offset", 1, Values({.02})), .05);
  EXPECT_LT(Apart("delay", -1, Values({.012})), .05);
}

TEST(EffectsInMujoco, JointsThatYieldFollowArmcal) {
  EXPECT_LT(Apart("elasticity", 1, Values({3e-4, .05, .05})), .05);
  EXPECT_LT(Apart("backlash", 0, Values({.01, .1, .2})), .05);
  EXPECT_LT(Apart("backlash", 1, Values({.01, .1, .2})), .1);
  EXPECT_LT(Apart("backlash", 2, Values({.01, .1, .2})), .15);
}

}  // namespace armcal::mujoco_effects_test
