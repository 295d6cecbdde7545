#include "model/robot/robot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::robot_test {

using Eigen::Matrix4d;
using Eigen::Vector3d;

// The matrices of the textbooks (Paul 1981; Craig 1986, 3.6), entry by entry.
Matrix4d Paul(double a, double d, double alpha, double theta) {
  const double ct = std::cos(theta), st = std::sin(theta);
  const double ca = std::cos(alpha), sa = std::sin(alpha);
  Matrix4d T;
  T << ct, -st * ca, st * sa, a * ct,  //
      st, ct * ca, -ct * sa, a * st,   //
      0, sa, ca, d,                    //
      0, 0, 0, 1;
  return T;
}

Matrix4d Craig(double a, double d, double alpha, double theta) {
  const double ct = std::cos(theta), st = std::sin(theta);
  const double ca = std::cos(alpha), sa = std::sin(alpha);
  Matrix4d T;
  T << ct, -st, 0, a,                  //
      st * ca, ct * ca, -sa, -sa * d,  //
      st * sa, ct * sa, ca, ca * d,    //
      0, 0, 0, 1;
  return T;
}

class DhPose : public testing::TestWithParam<JointType> {};

TEST_P(DhPose, AgreesWithTheTextbooks) {
  const DhParameters dh{0.4, -0.3, 0.7, 1.9};
  const double q = 0.6;
  const bool turns = GetParam() != JointType::kPrismatic;
  const double d = dh.d + (turns ? 0 : q);
  const double theta = dh.theta + (turns ? q : 0);
  Link link;
  link.joint.type = GetParam();
  SetDhPose(dh, DhConvention::kStandard, &link);
  EXPECT_TRUE(
      link.X_PL(q).matrix().isApprox(Paul(dh.a, d, dh.alpha, theta), 1e-15));
  EXPECT_TRUE(link.X_PF.isApprox(Eigen::Isometry3d::Identity(), 0));
  SetDhPose(dh, DhConvention::kModified, &link);
  EXPECT_TRUE(
      link.X_PL(q).matrix().isApprox(Craig(dh.a, d, dh.alpha, theta), 1e-15));
  EXPECT_TRUE(link.X_PF.matrix().isApprox(Craig(dh.a, 0, dh.alpha, 0), 1e-15));
}

INSTANTIATE_TEST_SUITE_P(JointTypes, DhPose,
                         testing::Values(JointType::kRevolute,
                                         JointType::kContinuous,
                                         JointType::kPrismatic));

// Fixed axes: first about x, then about the old y, then about the old z.
TEST(RotationFromRpy, TurnsAboutFixedAxes) {
  const double quarter = std::acos(0.0);
  const auto turn = [](const Vector3d& rpy, const Vector3d& v) {
    return Vector3d(RotationFromRpy(rpy) * v);
  };
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_TRUE(turn({quarter, 0, 0}, y).isApprox(z, 1e-15));
  EXPECT_TRUE(turn({0, quarter, 0}, z).isApprox(x, 1e-15));
  EXPECT_TRUE(turn({0, 0, quarter}, x).isApprox(y, 1e-15));
  EXPECT_TRUE(turn({quarter, quarter, 0}, y).isApprox(x, 1e-15));
  EXPECT_TRUE(turn({quarter, 0, quarter}, z).isApprox(x, 1e-15));
  EXPECT_TRUE(turn({0, quarter, quarter}, z).isApprox(y, 1e-15));
}

TEST(Robot, JointNamesRunFromBaseToTip) {
  Robot robot;
  EXPECT_TRUE(robot.JointNames().empty());
  robot.links.resize(2);
  robot.links[0].joint.name = "shoulder";
  robot.links[1].joint.name = "elbow";
  EXPECT_EQ(robot.JointNames(),
            (std::vector<std::string>{"shoulder", "elbow"}));
  EXPECT_EQ(robot.num_joints(), 2);
}

}  // namespace armcal::robot_test
