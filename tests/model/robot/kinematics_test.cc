#include "model/robot/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_robots.h"

namespace armcal::kinematics_test {

using Eigen::Isometry3d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979323846;

TEST(LinkPoses, PlanarArm) {
  const Robot robot = SampleRobot("2R planar (vertical plane)");  // .5, .4
  const double q1 = .7, q2 = -1.9;
  const auto X = LinkPoses(robot, Vector2d(q1, q2));
  ASSERT_EQ(X.size(), 2);
  const Vector3d elbow(.5 * std::cos(q1), .5 * std::sin(q1), 0);
  const Vector3d tip =
      elbow + .4 * Vector3d(std::cos(q1 + q2), std::sin(q1 + q2), 0);
  EXPECT_LT((X[0].translation() - elbow).norm(), 1e-14);
  EXPECT_LT((X[1].translation() - tip).norm(), 1e-14);
  EXPECT_NEAR(X[1].linear()(1, 0), std::sin(q1 + q2), 1e-14);
}

TEST(LinkPoses, Scara) {
  const Robot robot = SampleRobot("SCARA RRPR");  // .4, .3
  const Eigen::Vector4d q(.3, .8, .12, -.5);
  const Isometry3d X = LinkPoses(robot, q).back();
  EXPECT_NEAR(X.translation().x(), .4 * std::cos(.3) + .3 * std::cos(1.1),
              1e-14);
  EXPECT_NEAR(X.translation().y(), .4 * std::sin(.3) + .3 * std::sin(1.1),
              1e-14);
  EXPECT_NEAR(X.translation().z(), .12, 1e-14);
  EXPECT_NEAR(std::atan2(X.linear()(1, 0), X.linear()(0, 0)), .3 + .8 - .5,
              1e-14);
}

// Paul's DH matrix as printed in textbooks.
Matrix4d DhMatrix(double theta, double d, double a, double alpha) {
  const double c = std::cos(theta), s = std::sin(theta);
  const double ca = std::cos(alpha), sa = std::sin(alpha);
  Matrix4d T;
  T << c, -s * ca, s * sa, a * c, s, c * ca, -c * sa, a * s, 0, sa, ca, d, 0, 0,
      0, 1;
  return T;
}
// Craig's.
Matrix4d ModifiedDhMatrix(double theta, double d, double a, double alpha) {
  const double c = std::cos(theta), s = std::sin(theta);
  const double ca = std::cos(alpha), sa = std::sin(alpha);
  Matrix4d T;
  T << c, -s, 0, a, s * ca, c * ca, -sa, -sa * d, s * sa, c * sa, ca, ca * d, 0,
      0, 0, 1;
  return T;
}

TEST(LinkPoses, DhTablesOfBothConventions) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const bool standard = trial % 2 == 0;
    const VectorXd q = UniformVector(&random, 5, -3, 3);
    Robot robot;
    Matrix4d T = Matrix4d::Identity();
    for (int i = 0; i < 5; ++i) {
      const VectorXd v = UniformVector(&random, 4, -2, 2);
      const DhParameters dh{v[0], v[1], v[2], v[3]};  // a, d, alpha, theta
      Link link;
      const bool slides = Uniform(&random, 0, 1) < .4;
      if (slides) link.joint.type = JointType::kPrismatic;
      SetDhPose(dh,
                standard ? DhConvention::kStandard : DhConvention::kModified,
                &link);
      robot.links.push_back(link);
      const double theta = dh.theta + (slides ? 0 : q[i]);
      const double d = dh.d + (slides ? q[i] : 0);
      T = T * (standard ? DhMatrix(theta, d, dh.a, dh.alpha)
                        : ModifiedDhMatrix(theta, d, dh.a, dh.alpha));
      EXPECT_LT((LinkPoses(robot, q.head(i + 1)).back().matrix() - T)
                    .cwiseAbs()
                    .maxCoeff(),
                1e-12);
    }
  }
}

// The PUMA 560 in Corke's ready pose qr = (0, 90, -90, 0, 0, 0) deg stands
// straight up.
TEST(LinkPoses, PumaReady) {
  const Robot robot = SampleRobot("PUMA560 6R");
  VectorXd q = VectorXd::Zero(6);
  q[1] = kPi / 2;
  q[2] = -kPi / 2;
  const Isometry3d X = LinkPoses(robot, q).back();
  EXPECT_LT((X.translation() - Vector3d(.0203, -.15005, .8636)).norm(), 1e-12);
  EXPECT_LT((X.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(ToolPose, FollowsTheLastLink) {
  Robot robot = SampleRobot("2R planar (horizontal)");
  robot.X_LT.translation() << .1, 0, -.2;
  robot.X_LT.linear() = RotationFromRpy({0, 0, kPi / 2});
  const Isometry3d X = ToolPose(robot, Vector2d(kPi / 2, 0));
  EXPECT_LT((X.translation() - Vector3d(0, 1, -.2)).norm(), 1e-14);
  EXPECT_LT((X.linear().col(0) - Vector3d(-1, 0, 0)).norm(), 1e-14);
}

}  // namespace armcal::kinematics_test
