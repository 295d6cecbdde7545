#include "model/robot/arm_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fixtures/sample_robots.h"

namespace armcal::arm_geometry_test {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

Isometry3d RandomPose(std::mt19937_64* random) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = RotationFromRpy(UniformVector(random, 3, -1.4, 1.4));
  X.translation() = UniformVector(random, 3, -.5, .5);
  return X;
}

Robot Modified(int n, std::mt19937_64* random) {
  Robot robot = RandomArm(n, random);
  robot.dh_convention = DhConvention::kModified;
  for (Link& link : robot.links) {
    const VectorXd x = UniformVector(random, 4, -1, 1);
    const double twists[] = {0, M_PI / 2, -M_PI / 2, M_PI, 2 * x[2]};
    SetDhPose({x[0], x[1], twists[static_cast<int>(2.49 * (x[2] + 1))], x[3]},
              DhConvention::kModified, &link);
  }
  return robot;
}

// Frames as a URDF gives them: L = P moved by an origin, then about any axis.
Robot UrdfLike(int n, std::mt19937_64* random) {
  Robot robot = RandomArm(n, random);
  robot.dh_convention.reset();
  for (Link& link : robot.links) {
    Isometry3d onto_axis = Isometry3d::Identity();
    onto_axis.linear() = RandomPose(random).linear();
    link.X_PF = RandomPose(random) * onto_axis;
    link.X_ML = onto_axis.inverse();
  }
  return robot;
}

std::vector<Robot> Robots(std::mt19937_64* random) {
  std::vector<Robot> robots;
  for (const std::string& name : SampleRobotNames()) {
    robots.push_back(SampleRobot(name));
  }
  for (int n = 1; n <= 7; ++n) {
    robots.push_back(RandomArm(n, random));
    robots.push_back(Modified(n, random));
    robots.push_back(UrdfLike(n, random));
  }
  for (Robot& robot : robots) robot.X_LT = RandomPose(random);
  return robots;
}

Isometry3d Product(const Robot& robot, const VectorXd& q) {
  Isometry3d X = Isometry3d::Identity();
  for (int i = 0; i < robot.num_joints(); ++i) {
    X = X * robot.links[i].X_PL(q[i]);
  }
  return X * robot.X_LT;
}

Isometry3d Pose(const ArmGeometry& geometry, const VectorXd& q) {
  const VectorXd values = geometry.Values();
  return geometry.ToolPose(q, values.data(), nullptr);
}

double Gap(const Isometry3d& A, const Isometry3d& B) {
  return (A.matrix() - B.matrix()).cwiseAbs().maxCoeff();
}

int IndexOf(const ArmGeometry& geometry, const std::string& name) {
  const auto names = geometry.Names();
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

TEST(ArmGeometry, PosesAreTheProductOfTheLinks) {
  std::mt19937_64 random(1);
  for (const Robot& robot : Robots(&random)) {
    const ArmGeometry geometry(robot);
    ASSERT_EQ(geometry.Units().size(), geometry.Names().size());
    for (int trial = 0; trial < 5; ++trial) {
      const VectorXd q = UniformVector(&random, robot.num_joints(), -3, 3);
      EXPECT_LT(Gap(Pose(geometry, q), Product(robot, q)), 1e-12);
    }
  }
}

// Each parameter means what its name says: the DH row written out.
TEST(ArmGeometry, NamesMeanDhParameters) {
  for (const bool standard : {true, false}) {
    Robot robot;
    robot.dh_convention =
        standard ? DhConvention::kStandard : DhConvention::kModified;
    robot.links.resize(1);
    robot.links[0].name = "arm";
    SetDhPose({.3, .2, .5, .1}, *robot.dh_convention, &robot.links[0]);
    ArmGeometry geometry(robot);
    VectorXd g = geometry.Values();
    const double row[] = {.31, .22, .53, .14};  // a d alpha theta
    const char* names[] = {"arm.a", "arm.d", "arm.alpha", "arm.theta"};
    for (int k = 0; k < 4; ++k) {
      ASSERT_GE(IndexOf(geometry, names[k]), 0);
      g[IndexOf(geometry, names[k])] = row[k];
    }
    geometry.SetValues(g);
    const Eigen::Translation3d Tx(row[0], 0, 0), Tz(0, 0, row[1]);
    const AngleAxisd Rx(row[2], Vector3d::UnitX());
    const AngleAxisd Rz(row[3] + .7, Vector3d::UnitZ());
    const Isometry3d truth = standard ? Isometry3d(Rz * Tz * Tx * Rx)
                                      : Isometry3d(Rx * Tx * Rz * Tz);
    EXPECT_LT(Gap(Pose(geometry, VectorXd::Constant(1, .7)), truth), 1e-14);
  }
}

TEST(ArmGeometry, TwistsAreDerivatives) {
  std::mt19937_64 random(2);
  for (const Robot& robot : Robots(&random)) {
    const ArmGeometry geometry(robot);
    const VectorXd g =
        geometry.Values() + UniformVector(&random, geometry.size(), -.1, .1);
    const VectorXd q = UniformVector(&random, robot.num_joints(), -2, 2);
    std::vector<ParameterTwist> twists;
    const Isometry3d X = geometry.ToolPose(q, g.data(), &twists);
    ASSERT_EQ(static_cast<int>(twists.size()), geometry.size());
    for (int k = 0; k < geometry.size(); ++k) {
      VectorXd plus = g, minus = g;
      const double e = 1e-6;
      plus[k] += e;
      minus[k] -= e;
      const Isometry3d A = geometry.ToolPose(q, plus.data(), nullptr);
      const Isometry3d B = geometry.ToolPose(q, minus.data(), nullptr);
      const Vector3d p_T(.1, -.2, .3);
      EXPECT_LT(((A * p_T - B * p_T) / (2 * e) - twists[k].At(X * p_T)).norm(),
                1e-8)
          << geometry.Names()[k];
      const AngleAxisd turn(
          Eigen::Matrix3d(A.linear() * B.linear().transpose()));
      const Vector3d w = turn.angle() * turn.axis() / (2 * e);
      const Vector3d truth =
          twists[k].rotation ? twists[k].axis : Vector3d(Vector3d::Zero());
      EXPECT_LT((w - truth).norm(), 1e-8) << geometry.Names()[k];
    }
  }
}

TEST(ArmGeometry, JointsTwistsAreDerivatives) {
  std::mt19937_64 random(4);
  for (const Robot& robot : Robots(&random)) {
    const ArmGeometry geometry(robot);
    const VectorXd g = geometry.Values();
    const VectorXd q = UniformVector(&random, robot.num_joints(), -2, 2);
    std::vector<ParameterTwist> joints;
    const Isometry3d X = geometry.ToolPose(q, g.data(), nullptr, &joints);
    ASSERT_EQ(static_cast<int>(joints.size()), robot.num_joints());
    for (int j = 0; j < robot.num_joints(); ++j) {
      const VectorXd e = 1e-6 * VectorXd::Unit(q.size(), j);
      const Vector3d p_T(.1, -.2, .3);
      const Vector3d slope =
          (geometry.ToolPose(q + e, g.data(), nullptr) * p_T -
           geometry.ToolPose(q - e, g.data(), nullptr) * p_T) /
          2e-6;
      EXPECT_LT((slope - joints[j].At(X * p_T)).norm(), 1e-8) << j;
    }
  }
}

// Changed parameters survive into a robot, whose gravity is turned instead of
// its base, and from there into a new geometry.
TEST(ArmGeometry, AppliesToARobotAndBack) {
  std::mt19937_64 random(3);
  for (const Robot& robot : Robots(&random)) {
    ArmGeometry geometry(robot);
    geometry.SetValues(geometry.Values() +
                       UniformVector(&random, geometry.size(), -.03, .03));
    const Robot changed = geometry.ApplyTo(robot);
    VectorXd base = VectorXd::Zero(geometry.size());
    base.head(6) = geometry.Values().head(6);
    const VectorXd g = base.head(6);
    Isometry3d X_WB = Isometry3d::Identity();
    X_WB.translation() = g.head<3>();
    X_WB.linear() = RotationFromRpy({g[5], g[4], g[3]});
    EXPECT_LT((X_WB.linear() * changed.gravity - robot.gravity).norm(), 1e-12);
    const ArmGeometry again(changed);
    for (int trial = 0; trial < 3; ++trial) {
      const VectorXd q = UniformVector(&random, robot.num_joints(), -3, 3);
      const Isometry3d X_BT = X_WB.inverse() * Pose(geometry, q);
      EXPECT_LT(Gap(Product(changed, q), X_BT), 1e-12);
      EXPECT_LT(Gap(Pose(again, q), X_BT), 1e-12);
    }
    EXPECT_EQ(again.Names(), geometry.Names());
    if (!robot.dh_convention) continue;  // a URDF's zero goes into its origin
    const VectorXd gaps = again.Values() - geometry.Values() + base;
    for (const double gap : gaps) {
      EXPECT_LT(std::abs(std::remainder(gap, 2 * M_PI)), 1e-12);
    }
  }
}

// Hayati's beta where axes are nearly parallel: it moves the next axis by its
// own angle and keeps d well defined.
TEST(ArmGeometry, AddsBetaForNearlyParallelAxes) {
  const auto has = [](const Robot& robot, const std::string& name) {
    return IndexOf(ArmGeometry(robot), name) >= 0;
  };
  const Robot puma = SampleRobot("PUMA560 6R");
  EXPECT_FALSE(has(puma, "link1.beta"));
  EXPECT_TRUE(has(puma, "link2.beta"));
  EXPECT_FALSE(has(puma, "link3.beta"));
  EXPECT_FALSE(has(puma, "link6.beta"));
  for (const double tilt : {.05, M_PI - .05, .15}) {
    Robot robot = SampleRobot("2R planar (horizontal)");
    SetDhPose({.5, 0, tilt, 0}, DhConvention::kStandard, &robot.links[0]);
    EXPECT_EQ(has(robot, "link1.beta"), tilt != .15);
    robot.dh_convention = DhConvention::kModified;
    SetDhPose({.5, 0, tilt, 0}, DhConvention::kModified, &robot.links[1]);
    SetDhPose({0, 0, 0, 0}, DhConvention::kModified, &robot.links[0]);
    EXPECT_EQ(has(robot, "link2.beta"), tilt != .15);
    EXPECT_FALSE(has(robot, "link1.beta"));
  }
}

}  // namespace armcal::arm_geometry_test
