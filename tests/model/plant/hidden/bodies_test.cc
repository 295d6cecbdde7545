#include <gtest/gtest.h>

#include <cmath>

#include "model/dynamics/inverse_dynamics.h"
#include "tests/model/plant/hidden/hidden_plant.h"

namespace armcal::bodies_test {

using Eigen::Vector3d;
using Eigen::VectorXd;

VectorXd Held(const Robot& robot, const VectorXd& q) {
  const VectorXd zero = VectorXd::Zero(robot.num_joints());
  return InverseDynamics(robot, q, zero, zero);
}
VectorXd SomePose(int n) { return VectorXd::LinSpaced(n, -.8, 1.1); }

TEST(HiddenBodies, ArmatureIsAShareOfTheInertia) {
  const HiddenPlant plant("armature", 3, {.5});
  EXPECT_EQ(plant.robot.robot.links[3].joint.armature, 1);
  EXPECT_EQ(plant.Value("armature"), 1);
}

// The distance to the next joint grows by what was asked for, along itself.
TEST(HiddenBodies, LinksGrowLonger) {
  // PUMA's third link is twisted.
  for (const auto& [name, j] :
       {std::pair("UR5 6R", 1), {"PUMA560 6R", 2}, {"SCARA RRPR", 1}}) {
    HiddenPlant plant(name);
    plant.robot.robot.links[j + 1].X_PF.translation() << .1, -.2, .3;  // URDF
    const Robot before = plant.robot.robot;
    plant.Add("link_length", j, {.03});
    const Robot& after = plant.robot.robot;
    const auto next = [j = j](const Robot& robot) -> Vector3d {
      return (robot.links[j].X_ML * robot.links[j + 1].X_PF).translation();
    };
    Vector3d old = next(before), grown = next(after) - old;
    EXPECT_NEAR(grown.norm(), .03, 1e-12) << name;
    EXPECT_NEAR(grown.z(), 0, 1e-12) << name;
    old.z() = 0;
    EXPECT_NEAR(grown.dot(old), .03 * old.norm(), 1e-12) << name;
    // Only that changed: the link itself has its weight where it was, and the
    // next joint holds what it held.
    EXPECT_EQ(after.links[j].X_ML.matrix(), before.links[j].X_ML.matrix());
    const VectorXd q = SomePose(after.num_joints());
    EXPECT_NEAR(Held(after, q)[j + 1], Held(before, q)[j + 1], 1e-12) << name;
  }
}

TEST(HiddenBodies, TiltTurnsGravity) {
  for (const double direction : {.0, 1., 4.}) {
    const HiddenPlant plant("base_tilt", -1, {.05, direction});
    const Vector3d& g = plant.robot.robot.gravity;
    EXPECT_NEAR(g.norm(), 9.81, 1e-12);
    EXPECT_NEAR(g.z(), -9.81 * std::cos(.05), 1e-12);
    EXPECT_EQ(plant.Value("gravity_x"), g.x());
  }
  // Directions are directions.
  const HiddenPlant a("base_tilt", -1, {.05, 0}), b("base_tilt", -1, {.05, 2});
  const double dot = a.robot.robot.gravity.head<2>().normalized().dot(
      b.robot.robot.gravity.head<2>().normalized());
  EXPECT_NEAR(dot, std::cos(2), 1e-9);
}

// The payload's weight at every joint: J^T of a force at its place.
TEST(HiddenBodies, PayloadWeighs) {
  HiddenPlant plant;
  plant.robot.robot.X_LT.translation() = Vector3d(0, .1, .2);
  const Robot before = plant.robot.robot;
  plant.Add("payload", -1, {.05, .02, -.03, .04});
  double arm_mass = 0;
  for (const Link& link : before.links) arm_mass += link.inertial.mass;
  const double m = plant.Value("mass");
  EXPECT_NEAR(m, .05 * arm_mass, 1e-12);
  const Vector3d com(plant.Value("com_x"), plant.Value("com_y"),
                     plant.Value("com_z"));
  EXPECT_NEAR((com - Vector3d(.02, .07, .24)).norm(), 0, 1e-12);
  const VectorXd q = SomePose(6);
  const auto height = [&](const VectorXd& at) {
    Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();
    for (int j = 0; j < 6; ++j) X_WL = X_WL * before.links[j].X_PL(at[j]);
    return (X_WL * com).z();
  };
  const VectorXd added = Held(plant.robot.robot, q) - Held(before, q);
  for (int j = 0; j < 6; ++j) {
    const VectorXd h = 1e-6 * VectorXd::Unit(6, j);
    const double slope = (height(q + h) - height(q - h)) / 2e-6;
    EXPECT_NEAR(added[j], m * 9.81 * slope, 1e-7) << j;
  }
}

// A weight on a link: its mass and its moments add, its own edge is a cube's.
TEST(HiddenBodies, AddedMassAddsToOneLink) {
  HiddenPlant plant;
  const Robot before = plant.robot.robot;
  plant.Add("added_mass", 2, {.05, .1, -.2, .3});
  const double m = plant.Value("mass");
  EXPECT_EQ(plant.Value("hz"), m * .3);
  for (int j = 0; j < 6; ++j) {
    const Vector10d added = plant.robot.robot.links[j].inertial.ToVector() -
                            before.links[j].inertial.ToVector();
    if (j != 2) {
      EXPECT_EQ(added.norm(), 0) << j;
      continue;
    }
    EXPECT_NEAR(added[0], m, 1e-12);
    EXPECT_NEAR((added.segment<3>(1) - m * Vector3d(.1, -.2, .3)).norm(), 0,
                1e-12);
    const double own = m * std::pow(m / 2700, 2 / 3.) / 6;
    EXPECT_NEAR(added[4], m * (.2 * .2 + .3 * .3) + own, 1e-12);  // Ixx
    EXPECT_NEAR(added[5], m * .1 * .2, 1e-12);                    // Ixy
  }
}

TEST(HiddenBodies, LinkInertiaScalesOneLink) {
  HiddenPlant plant;
  const Robot before = plant.robot.robot;
  plant.Add("link_inertia", 2, {-.2});
  for (int j = 0; j < 6; ++j) {
    EXPECT_LT((plant.robot.robot.links[j].inertial.ToVector() -
               (j == 2 ? .8 : 1) * before.links[j].inertial.ToVector())
                  .norm(),
              1e-14);
  }
}

// The arm above a swaying base is the same arm, whatever was applied before.
TEST(HiddenBodies, MountMovesAllIndicesUp) {
  HiddenPlant plant("coulomb_friction", 2, {.1});
  plant.Add("gyroscope", 3, {.1});
  plant.Add("elasticity", 1, {.002, .05});
  const Robot before = plant.robot.robot;
  plant.at.velocity << 0, 0, .3, 0, 0, 0;
  const double friction = plant.Torque();
  plant.Add("mount_resonance", -1, {8, .03});
  const SimulatedRobot& robot = plant.robot;
  ASSERT_EQ(robot.num_passive, 2);
  EXPECT_EQ(robot.joint_laws[0].joint, 4);
  EXPECT_EQ(robot.transmissions[0].joint, 3);
  EXPECT_EQ(robot.wrenches[0].attachment.link, 5);
  plant.at.position = plant.at.velocity = VectorXd::Zero(8);
  plant.at.velocity[4] = .3;
  EXPECT_EQ(plant.Torque(), friction);
  VectorXd q = VectorXd::Zero(8);
  q.tail(6) = SomePose(6);
  const VectorXd held = Held(robot.robot, q);
  EXPECT_LT((held.tail(6) - Held(before, SomePose(6))).norm(), 1e-9);
  // A spring and damper under each of two level axes across one another.
  const double k = plant.Value("stiffness");
  plant.at.position[1] = .01;
  EXPECT_EQ(robot.joint_laws[1].joint, 1);
  EXPECT_NEAR(plant.Torque(1), -k * .01, 1e-9);
  EXPECT_EQ(robot.joint_laws[2].joint, 0);
  EXPECT_NEAR(plant.Torque(2), 0, 1e-9);
  plant.at.velocity[0] = .1;
  EXPECT_LT(plant.Torque(2), 0);
}

}  // namespace armcal::bodies_test
