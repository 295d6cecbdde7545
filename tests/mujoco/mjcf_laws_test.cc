// Forces of laws that are written as soft constraints are those that were
// meant. (Bristles, ripple and dead bands of tendons need a MuJoCo newer than
// ctest has: tests/robots/mjcf_replay.py.)

#include "model/robot_files/mjcf_laws.h"

#include <gtest/gtest.h>

#include <string>

#include "model/robot_files/mjcf_writer.h"
#include "tests/fixtures/two_link_arm.h"
#include "tests/mujoco/mujoco_model.h"

namespace armcal::mujoco_mjcf_laws_test {

RobotDescription Arm() {
  RobotDescription description{TwoLinkArm().ToNamedRobot(), {}};
  description.robot.gravity.setZero();
  for (Link& link : description.robot.links) link.joint.armature = .2;
  description.drives.resize(2);
  return description;
}

// Position and velocity of a joint after `duration` under torques.
struct State {
  double q, qd;
};
class Pushed {
 public:
  Pushed(const RobotDescription& description, double torque1, double torque2,
         double duration)
      : model_(LoadTextInMujoco(MakeMjcf(description), "laws.xml")),
        data_(mj_makeData(model_.get()), mj_deleteData) {
    data_->ctrl[0] = torque1;
    data_->ctrl[1] = torque2;
    while (data_->time < duration) mj_step(model_.get(), data_.get());
  }
  State At(const std::string& joint) const {
    const int id = mj_name2id(model_.get(), mjOBJ_JOINT, joint.c_str());
    EXPECT_GE(id, 0) << joint;
    return {data_->qpos[model_->jnt_qposadr[id]],
            data_->qvel[model_->jnt_dofadr[id]]};
  }

 private:
  MujocoModel model_;
  MujocoData data_;
};

// Below its force, friction is a damper of force over width: the parts that
// saturate first have given all of theirs.
TEST(MujocoMjcfLaws, DryFrictionChangesSignWithinItsWidth) {
  RobotDescription arm = Arm();
  arm.drives[0].dry = {{.8, .01}, {.2, .002}};
  arm.drives[1].dry = {{5, .01}};
  EXPECT_NEAR(Pushed(arm, .1, 0, .4).At("joint1").qd, .1 / 180, 2e-6);
  EXPECT_NEAR(Pushed(arm, .6, 0, .4).At("joint1").qd, .4 / 80, 2e-5);
}

// Friction that falls with velocity: what stands beside friction itself pushes
// along the velocity, up to its limit.
TEST(MujocoMjcfLaws, FrictionFallsByAPush) {
  RobotDescription arm = Arm();
  arm.drives[0].dry = {{3, .01}, {-1, .5}};
  const MujocoModel model = LoadTextInMujoco(MakeMjcf(arm), "push.xml");
  const MujocoData data(mj_makeData(model.get()), mj_deleteData);
  for (const auto& [v, push] : {std::pair(.1, .2), {.4, .8}, {2., 1.}}) {
    for (const double sign : {1., -1.}) {
      data->qvel[0] = sign * v;
      mj_forward(model.get(), data.get());
      EXPECT_NEAR(data->qfrc_actuator[0], sign * push, 1e-8) << v;
      EXPECT_NEAR(data->qfrc_actuator[1], 0, 1e-12) << v;
    }
  }
}

// A spring holds the motor, and so says what torque the link's weight puts on
// the flanks.
TEST(MujocoMjcfLaws, FlanksYieldBehindTheGap) {
  RobotDescription arm = Arm();
  arm.robot.links[1].joint.viscous = 20;
  arm.drives[1].gear = GearSpring{.02, 400, 20, 0};
  arm.robot.gravity = Eigen::Vector3d(0, -9.81, 0);
  arm.drives[1].stiffness = 5000;
  arm.drives[0].stiffness = 5000;
  arm.robot.links[0].joint.viscous = 100;
  const Pushed still(arm, 0, 0, 4);
  const double wound = still.At("joint2_gear").q;
  const double torque = -5000 * still.At("joint2").q;  // of the motor's spring
  EXPECT_NEAR(still.At("joint2_gear").qd, 0, 1e-6);
  EXPECT_GT(std::abs(torque), 1);
  // The link lags its motor, which holds it.
  EXPECT_NEAR(wound, -std::copysign(.01, torque) - torque / 400,
              .02 * std::abs(torque) / 400);
}

TEST(MujocoMjcfLaws, AGearWindsUpByItsLoad) {
  RobotDescription arm = Arm();
  arm.robot.gravity = Eigen::Vector3d(0, -9.81, 0);
  for (int j = 0; j < 2; ++j) {
    arm.drives[j].stiffness = 5000;
    arm.robot.links[j].joint.viscous = 100;
  }
  arm.drives[1].gear = GearSpring{0, 400, 20, 0};
  const Pushed still(arm, 0, 0, 4);
  const double torque = -5000 * still.At("joint2").q;
  EXPECT_GT(std::abs(torque), 1);
  EXPECT_NEAR(still.At("joint2_gear").q, -torque / 400,
              1e-4 * std::abs(torque) / 400);
}

}  // namespace armcal::mujoco_mjcf_laws_test
