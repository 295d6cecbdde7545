// MJCF files in MuJoCo: what we read, and what we write. Built where
// find_package(mujoco) finds it.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "model/dynamics/inverse_dynamics.h"
#include "model/robot/kinematics.h"
#include "model/robot_files/mjcf/mjcf_reader.h"
#include "model/robot_files/mjcf_writer.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/mujoco/mujoco_model.h"

namespace armcal::mjcf_test {

using Eigen::VectorXd;

constexpr int kStates = 20;
// Draws MJCF that says the same in all ways. With `principal` inertias are
// along axes that the file gives.
class RandomMjcf {
 public:
  RandomMjcf(int seed, bool principal) : random_(seed), principal_(principal) {}
  std::string Text(const std::string& compiler = "") {
    degrees_ = Chance(.5);
    std::string euler;
    for (int i = 0; i < 3; ++i) euler += "xyzXYZ"[Pick(6)];
    std::string bodies;
    const int n = 3 + Pick(4);
    for (int i = 0; i < n; ++i) bodies += Body(i);
    for (int i = 0; i < n; ++i) bodies += "</body>";
    return std::string("<mujoco model='random'><compiler angle='") +
           (degrees_ ? "degree" : "radian") + "' eulerseq='" + euler + "' " +
           compiler + "/><option gravity='" + Numbers(3, -9, 9) +
           "'/><default><joint armature='0.1'/><geom density='700'/>"
           "<default class='a'><joint damping='0.5' axis='0 1 0'/>"
           "<default class='b'><joint frictionloss='0.3' armature='0.2'/>"
           "<geom density='300'/></default></default></default><worldbody>" +
           bodies + "</worldbody></mujoco>";
  }
  std::mt19937_64* random() { return &random_; }

 private:
  int Pick(int n) { return std::min(n - 1, int(Uniform(&random_, 0, n))); }
  bool Chance(double p) { return Uniform(&random_, 0, 1) < p; }
  std::string Numbers(int n, double low, double high) {
    std::string text;
    for (int i = 0; i < n; ++i) {
      text += (i ? " " : "") + std::to_string(Uniform(&random_, low, high));
    }
    return text;
  }
  double Turn() { return degrees_ ? 180 : 3.14; }

  std::string Pose() {
    const std::string pos = " pos='" + Numbers(3, -.5, .5) + "'";
    switch (Pick(6)) {
      case 0:
        return pos + " quat='" + Numbers(4, -1, 1) + "'";
      case 1:
        return pos + " euler='" + Numbers(3, -Turn(), Turn()) + "'";
      case 2:
        return pos + " axisangle='" + Numbers(3, -1, 1) + " " +
               Numbers(1, -Turn(), Turn()) + "'";
      case 3:
        return pos + " xyaxes='" + Numbers(6, -1, 1) + "'";
      case 4:
        return pos + " zaxis='" + Numbers(3, -1, 1) + "'";
    }
    return pos;
  }

  std::string Geom() {
    const std::string mass =
        Chance(.3) ? " mass='" + Numbers(1, .1, 2) + "'" : "";
    const char* types[] = {"sphere", "capsule", "cylinder", "box", "ellipsoid"};
    const int type = Pick(5);
    std::string text = std::string("<geom type='") + types[type] + "'" + mass;
    if (type > 0 && Chance(.4)) {
      text += " fromto='" + Numbers(6, -.3, .3) + "' size='0.04'";
    } else {
      text += Pose() + " size='" + Numbers(3, .03, .2) + "'";
    }
    return text + "/>";
  }

  std::string Body(int i) {
    const std::string number = std::to_string(i);
    std::string text = "<body name='body" + number + "'" + Pose();
    if (Chance(.4)) text += Chance(.5) ? " childclass='a'" : " childclass='b'";
    text += ">";
    switch (principal_ ? 0 : Pick(3)) {
      case 0:
        text += "<inertial" + Pose() + " mass='" + Numbers(1, .5, 4) +
                "' diaginertia='0.03 0.02 0.04'/>";
        break;
      case 1:
        text += "<inertial pos='" + Numbers(3, -.2, .2) +
                "' mass='2' fullinertia='0.03 0.02 0.04 " +
                Numbers(3, -.004, .004) + "'/>";
        break;
      default:
        text += Geom() + Geom();
    }
    const int joints = i == 0 ? 1 : Pick(4) == 0 ? 0 : 1 + Pick(2);
    for (int k = 0; k < joints; ++k) text += JointText();
    if (Chance(.3)) {  // beside the chain, fixed
      text += "<body name='side" + number + "'" + Pose() +
              "><inertial pos='0 0 .1' mass='0.3' "
              "diaginertia='.01 .01 .01'/></body>";
    }
    return text;
  }

  std::string JointText() {
    std::string text = "<joint name='joint" + std::to_string(joints_++) + "'";
    if (Chance(.3)) text += " type='slide'";
    if (Chance(.7)) text += " pos='" + Numbers(3, -.2, .2) + "'";
    if (Chance(.7)) text += " axis='" + Numbers(3, -1, 1) + "'";
    if (Chance(.5)) text += " ref='" + Numbers(1, -1, 1) + "'";
    if (Chance(.3)) text += " damping='" + Numbers(1, 0, 2) + "'";
    if (Chance(.3)) text += Chance(.5) ? " class='a'" : " class='b'";
    return text + "/>";
  }

  std::mt19937_64 random_;
  bool principal_;
  bool degrees_ = true;
  int joints_ = 0;
};

// mj_inverse without dry friction and limits.
class Referee {
 public:
  Referee(const std::string& xml, const Robot& robot)
      : model_(LoadTextInMujoco(xml, "referee.xml")),
        data_(mj_makeData(model_.get()), mj_deleteData),
        joints_(robot, *model_) {
    model_->opt.disableflags |= mjDSBL_CONSTRAINT;
  }
  VectorXd Torque(const VectorXd& q, const VectorXd& qd, const VectorXd& qdd) {
    joints_.SetMotion(q, qd, qdd, data_.get());
    mj_inverse(model_.get(), data_.get());
    return joints_.Read(data_->qfrc_inverse);
  }
  // Of the motors alone, that the arm moves so.
  VectorXd Acceleration(const VectorXd& q, const VectorXd& qd,
                        const VectorXd& ctrl) {
    joints_.SetMotion(q, qd, 0 * qd, data_.get());
    for (int j = 0; j < ctrl.size(); ++j) data_->ctrl[j] = ctrl[j];
    mj_forward(model_.get(), data_.get());
    return joints_.Read(data_->qacc);
  }
  Eigen::Vector3d Position(const std::string& body) const {
    const int id = mj_name2id(model_.get(), mjOBJ_BODY, body.c_str());
    return Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * id);
  }
  const mjModel& model() const { return *model_; }
  const MujocoJoints& joints() const { return joints_; }

 private:
  MujocoModel model_;
  MujocoData data_;
  MujocoJoints joints_;
};

// What the robot's own terms add to the rigid arm.
VectorXd Torque(const Robot& robot, const VectorXd& q, const VectorXd& qd,
                const VectorXd& qdd) {
  VectorXd tau = InverseDynamics(robot, q, qd, qdd);
  for (int j = 0; j < robot.num_joints(); ++j) {
    const Joint& joint = robot.links[j].joint;
    tau[j] += joint.viscous * qd[j] + joint.armature * qdd[j];
  }
  return tau;
}

void ExpectSameAsReferee(const Robot& robot, std::mt19937_64* random,
                         Referee* referee, double relative) {
  const int n = robot.num_joints();
  for (int k = 0; k < kStates; ++k) {
    const VectorXd q = UniformVector(random, n, -3, 3);
    const VectorXd qd = UniformVector(random, n, -2, 2);
    const VectorXd qdd = UniformVector(random, n, -5, 5);
    const VectorXd ours = Torque(robot, q, qd, qdd);
    const VectorXd theirs = referee->Torque(q, qd, qdd);
    EXPECT_LE((theirs - ours).norm(), relative * ours.norm());
    if (robot.tool_name.empty()) continue;
    EXPECT_LE(
        (referee->Position(robot.tool_name) - ToolPose(robot, q).translation())
            .norm(),
        relative);
  }
  for (int j = 0; j < n; ++j) {
    EXPECT_EQ(referee->model().dof_frictionloss[referee->joints().v[j]],
              robot.links[j].joint.coulomb);
  }
}

void ExpectReadAsMujocoDoes(int seed, bool principal, double relative,
                            const std::string& compiler = "") {
  RandomMjcf text(seed, principal);
  const std::string xml = text.Text(compiler);
  const Robot robot = ReadMjcf(WriteFile(xml, "random.xml"), {});
  Referee referee(xml, robot);
  ExpectSameAsReferee(robot, text.random(), &referee, relative);
  ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << "\n" << xml;
}

TEST(MujocoMjcf, ReadsAsMujocoDoes) {
  for (int seed = 1; seed <= 60; ++seed) {
    ExpectReadAsMujocoDoes(seed, true, 1e-10);
  }
}

// Bodies of 0.3 kg and moments of 0.01 are below the bounds, others above.
TEST(MujocoMjcf, ChangesBodiesAsTheCompilerDoes) {
  const char kBounds[] = "boundmass='1.2' boundinertia='.025' settotalmass='3'";
  for (int seed = 1; seed <= 30; ++seed) {
    ExpectReadAsMujocoDoes(seed, true, 1e-9, kBounds);
  }
}

// MuJoCo finds the principal axes of these itself, by sqrt((1 - c) / 2) of the
// cosines of its last, small rotations: to about 1e-8 rad.
TEST(MujocoMjcf, ReadsFullInertiaAndGeomsAsMujocoDoes) {
  for (int seed = 1; seed <= 60; ++seed) {
    ExpectReadAsMujocoDoes(seed, false, 1e-6);
  }
}

Robot FullArm(int seed) {
  std::mt19937_64 random(seed);
  Robot robot = RandomArm(3 + seed % 4, &random);
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) {
    link.joint.viscous = Uniform(&random, 0, 3);
    link.joint.coulomb = Uniform(&random, 0, 3);
    link.joint.armature = Uniform(&random, 0, .4);
    link.joint.offset = Uniform(&random, -2, 2);
    link.joint.effort = Uniform(&random, 500, 900);
  }
  robot.tool_name = "tool";
  robot.X_LT.translation() = Eigen::Vector3d(.1, .2, .3);
  return robot;
}

TEST(MujocoMjcf, WritesForMujoco) {
  for (int seed = 1; seed <= 30; ++seed) {
    const Robot robot = FullArm(seed);
    std::mt19937_64 random(seed);
    Referee referee(MakeMjcf({robot, {}}), robot);
    ExpectSameAsReferee(robot, &random, &referee, 1e-10);
  }
}

// A link without mass is a joint of the next body.
TEST(MujocoMjcf, WritesMasslessLinksAsJointsOfTheNext) {
  for (int seed = 1; seed <= 10; ++seed) {
    Robot robot = FullArm(seed);
    Link& massless = robot.links[seed % (robot.num_joints() - 1)];
    massless.has_inertial = false;
    massless.inertial = InertialParameters();
    std::mt19937_64 random(seed);
    Referee referee(MakeMjcf({robot, {}}), robot);
    ExpectSameAsReferee(robot, &random, &referee, 1e-10);
  }
}

// The motors take our torque: with constant torques, gains and springs.
TEST(MujocoMjcf, MotorsMoveItAsWeSay) {
  for (int seed = 1; seed <= 10; ++seed) {
    RobotDescription description{FullArm(seed), {}};
    const Robot& robot = description.robot;
    const int n = robot.num_joints();
    for (int j = 0; j < n; ++j) {
      description.drives.push_back({2. + j, .3, .9 + .05 * j});
    }
    std::mt19937_64 random(seed);
    Referee referee(MakeMjcf(description), robot);
    const VectorXd q = UniformVector(&random, n, -1, 1);
    const VectorXd qd = UniformVector(&random, n, -1, 1);
    const VectorXd qdd = UniformVector(&random, n, -2, 2);
    VectorXd ctrl = Torque(robot, q, qd, qdd);
    for (int j = 0; j < n; ++j) {
      const JointDrive& drive = description.drives[j];
      ctrl[j] +=
          robot.links[j].joint.offset + drive.stiffness * (q[j] - drive.rest);
      ctrl[j] /= drive.gain;
      ASSERT_LE(std::abs(ctrl[j]), robot.links[j].joint.effort);
    }
    EXPECT_LE((referee.Acceleration(q, qd, ctrl) - qdd).norm(), 1e-8);
    // Beyond the limit nothing more comes.
    const VectorXd limit = referee.Acceleration(q, qd, 0 * ctrl.array() + 1e3);
    EXPECT_EQ(limit, referee.Acceleration(q, qd, 0 * ctrl.array() + 1e4));
  }
}

// Position drives push as our law, within their limits.
TEST(MujocoMjcf, DrivesPushAsOurLawSays) {
  for (int seed = 1; seed <= 10; ++seed) {
    RobotDescription description{FullArm(seed), {}};
    const Robot& robot = description.robot;
    const int n = robot.num_joints();
    std::mt19937_64 random(seed);
    const VectorXd q = UniformVector(&random, n, -1, 1);
    const VectorXd qd = UniformVector(&random, n, -1, 1);
    const VectorXd q_ref = UniformVector(&random, n, -1, 1);
    description.controller =
        DefaultController(robot, VectorXd::Zero(n), 3, DriveKind::kP);
    VectorXd torque(n);
    for (int j = 0; j < n; ++j) {
      DriveLaw& law = description.controller->drives[j];
      if (j == 1) law.torque_limit = 1;
      torque[j] = Drive(law, {q_ref[j], 0, 0, q[j], qd[j]}, 0).torque;
    }
    // The same torque by the motors of the same robot.
    RobotDescription motors{robot, {}};
    Referee driven(MakeMjcf(description), robot);
    Referee pushed(MakeMjcf(motors), robot);
    const VectorXd expected = pushed.Acceleration(q, qd, torque);
    EXPECT_LE((driven.Acceleration(q, qd, q_ref) - expected).norm(),
              1e-9 * expected.norm());
  }
}

}  // namespace armcal::mjcf_test
