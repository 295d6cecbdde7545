#include "model/robot_files/urdf_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "model/robot_files/robot_reader.h"
#include "model/robot_files/urdf_tree.h"
#include "tests/fixtures/urdf_text.h"

namespace armcal::urdf_reader_test {

using namespace urdf_text;

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kQuarter = std::acos(0.0);

Isometry3d Tip(const Robot& robot, const Eigen::VectorXd& q) {
  Isometry3d X = Isometry3d::Identity();
  for (int i = 0; i < robot.num_joints(); ++i)
    X = X * robot.links[i].X_PL(q[i]);
  return X * robot.X_LT;
}

struct AxisCase {
  const char* text;
  Vector3d axis;
  bool is_exact;
};

// URDF: a joint turns its child about the axis, which is given in the child's
// frame at q = 0.
TEST(UrdfReader, TurnsAndMovesAboutAnyAxis) {
  Isometry3d X_PJ = Isometry3d::Identity();
  X_PJ.linear() =
      (AngleAxisd(0.7, Vector3d::UnitZ()) *
       AngleAxisd(-0.5, Vector3d::UnitY()) * AngleAxisd(0.3, Vector3d::UnitX()))
          .toRotationMatrix();
  X_PJ.translation() << 1, 2, 3;
  for (const AxisCase& c : std::initializer_list<AxisCase>{
           {"0 0 1", {0, 0, 1}, true},
           {"0 0 -1", {0, 0, -1}, true},
           {"1 0 0", {1, 0, 0}, true},
           {"-1 0 0", {-1, 0, 0}, true},
           {"0 1 0", {0, 1, 0}, true},
           {"0 -1 0", {0, -1, 0}, true},
           {"0.48 -0.6 0.64", {0.48, -0.6, 0.64}, false},
           {"0.48 -0.6 -0.64", {0.48, -0.6, -0.64}, false},
           {"1e-9 0 -1", {1e-9, 0, -1}, false}}) {
    for (const std::string type : {"continuous", "prismatic"}) {
      SCOPED_TRACE(type + " " + c.text);
      const auto read = [&](const std::string& origin) {
        return Read(LinkXml("a") + LinkXml("b") +
                    JointXml("j", type, "a", "b",
                             origin + "<axis xyz='" + c.text + "'/>"));
      };
      const Link link =
          read("<origin xyz='1 2 3' rpy='0.3 -0.5 0.7'/>").links[0];
      const double q = 0.8;
      const Isometry3d X_JL = type == "prismatic"
                                  ? Isometry3d(Translation3d(q * c.axis))
                                  : Isometry3d(AngleAxisd(q, c.axis));
      EXPECT_TRUE(link.X_PL(q).isApprox(X_PJ * X_JL, 1e-14));
      EXPECT_TRUE(link.X_PL(0).isApprox(X_PJ, 1e-14));
      EXPECT_NEAR(link.X_PF.linear().determinant(), 1, 1e-14);
      const Eigen::Matrix3d R = read("").links[0].X_PF.linear();
      EXPECT_TRUE(R.col(2).isApprox(c.axis, 1e-15));
      EXPECT_EQ(c.is_exact, R == R.array().round().matrix());
    }
  }
}

TEST(UrdfReader, AxisDefaultsToXAndIsNormalised) {
  const Robot robot =
      Read(LinkXml("a") + LinkXml("b") + LinkXml("c") +
           JointXml("j1", "continuous", "a", "b") +
           JointXml("j2", "continuous", "b", "c", "<axis xyz='0 0 2'/>"));
  EXPECT_EQ(Vector3d(robot.links[0].X_PF.linear().col(2)), Vector3d(1, 0, 0));
  EXPECT_EQ(Vector3d(robot.links[1].X_PF.linear().col(2)), Vector3d(0, 0, 1));
  EXPECT_THAT(robot.notes,
              ElementsAre("the axis of joint 'j2' has length 2, normalised to "
                          "1"));
}

TEST(UrdfReader, Planar2RTip) {
  const Robot robot =
      Read(LinkXml("base") + LinkXml("a") + LinkXml("b") + LinkXml("tip") +
           JointXml("q1", "continuous", "base", "a", "<axis xyz='0 0 1'/>") +
           JointXml("q2", "continuous", "a", "b",
                    "<origin xyz='0.4 0 0'/><axis xyz='0 0 1'/>") +
           JointXml("end", "fixed", "b", "tip", "<origin xyz='0.3 0 0'/>"));
  EXPECT_EQ(robot.tool_name, "tip");
  const Vector3d p = Tip(robot, Eigen::Vector2d(0.5, 0.9)).translation();
  EXPECT_NEAR(p.x(), 0.4 * std::cos(0.5) + 0.3 * std::cos(1.4), 1e-15);
  EXPECT_NEAR(p.y(), 0.4 * std::sin(0.5) + 0.3 * std::sin(1.4), 1e-15);
  EXPECT_EQ(p.z(), 0);
}

// Two bodies of 2 kg at x = 0.1 and 1 kg at x = 0.5, the second turned by a
// quarter about z; summed by hand.
TEST(UrdfReader, LumpsFixedLinks) {
  const std::string quarter = "1.5707963267948966";
  const Robot robot =
      Read(LinkXml("base", Inertial("", "9", "1", "1", "1")) +
           LinkXml("arm", Inertial("xyz='0.1 0 0'", "2", "0.1", "0.1", "0.1")) +
           LinkXml("hand", Inertial("", "1", "0.01", "0.02", "0.025")) +
           LinkXml("camera") +
           JointXml("j", "continuous", "base", "arm", "<axis xyz='0 0 1'/>") +
           JointXml("f", "fixed", "arm", "hand",
                    "<origin xyz='0.5 0 0' rpy='0 0 " + quarter +
                        "'/><axis xyz='0 0 0'/><limit lower='2' upper='1'/>") +
           JointXml("g", "fixed", "arm", "camera"));
  ASSERT_EQ(robot.num_joints(), 1);
  Vector10d expected;
  expected << 3, 0.7, 0, 0, 0.12, 0, 0.38, 0, 0, 0.395;
  EXPECT_LT((robot.links[0].inertial.ToVector() - expected).norm(), 1e-15);
  EXPECT_TRUE(robot.links[0].has_inertial);
  EXPECT_EQ(robot.tool_name, "");  // two fixed leaves: no guess
  EXPECT_TRUE(robot.X_LT.isApprox(Isometry3d::Identity(), 0));
  EXPECT_THAT(
      robot.notes,
      ElementsAre("not used, as they do not move: the inertia of base",
                  "lumped into link 'arm' by fixed joints: hand, camera"));
}

TEST(UrdfReader, RotatedInertialFrame) {
  const Robot robot =
      Read(LinkXml("base") +
           LinkXml("arm", Inertial("rpy='0 1.5707963267948966 0'", "2", "0.1",
                                   "0.2", "0.25")) +
           JointXml("j", "continuous", "base", "arm"));
  const Vector3d diagonal = robot.links[0].inertial.inertia.diagonal();
  EXPECT_TRUE(diagonal.isApprox(Vector3d(0.25, 0.2, 0.1), 1e-15));
}

TEST(UrdfReader, LimitsFrictionAndStartValues) {
  const Robot robot =
      Read(LinkXml("a") + LinkXml("b", Inertial("", "0", "1", "1", "1")) +
           LinkXml("c", Inertial("", "1", "1", "1", "3")) + LinkXml("d") +
           JointXml("j1", "revolute", "a", "b",
                    "<limit lower='-1' upper='2' effort='10' velocity='3'/>"
                    "<dynamics damping='0.5' friction='0.25'/>") +
           JointXml("j2", "revolute", "b", "c",
                    "<limit lower='0' upper='0' effort='0' velocity=' 3 '/>") +
           JointXml("j3", "prismatic", "c", "d"));
  const Joint& j1 = robot.links[0].joint;
  EXPECT_EQ(j1.lower, -1);
  EXPECT_EQ(j1.upper, 2);
  EXPECT_EQ(j1.effort, 10);
  EXPECT_EQ(j1.velocity, 3);
  EXPECT_EQ(j1.viscous, 0.5);
  EXPECT_EQ(j1.coulomb, 0.25);
  const Joint& j2 = robot.links[1].joint;
  EXPECT_EQ(j2.lower, -kInfinity);
  EXPECT_EQ(j2.upper, kInfinity);
  EXPECT_EQ(j2.effort, kInfinity);
  EXPECT_EQ(j2.velocity, 3);
  EXPECT_FALSE(robot.links[0].has_inertial);
  EXPECT_EQ(robot.links[0].inertial.ToVector(), Vector10d::Zero());
  EXPECT_TRUE(robot.links[1].has_inertial);
  EXPECT_THAT(
      robot.notes,
      ElementsAre(
          "link 'b' has moments of inertia without a mass; they count where "
          "it is fixed to a link with one",
          "joint 'j2' has the effort limit 0, read as not given",
          "joint 'j2' has equal lower and upper limits, read as none",
          "the inertia of link 'c' is no rigid body's (principal moments about "
          "the centre of mass 1, 1, 3 kg m^2 break the triangle inequality); "
          "it serves as a start value only",
          "joint 'j3' has no limits"));
}

std::string Shared(const std::string& name) {
  return std::string(SHARED_DIR) + "/data/" + name;
}

// The folder's dh.txt is the source its URDF was made from: modified DH.
// A whole turn, rounded, is what exporters write; what cannot be read is the
// reader's to tell.
TEST(UrdfReader, AnglesOfMoreThanAWholeTurn) {
  const Document file(
      "arm.urdf",
      "<robot><link name='a'><inertial><origin rpy='0 90 0'/></inertial></link>"
      "<link name='b'><inertial><origin rpy='x'/></inertial></link>"
      "<joint name='j'><origin rpy='1 -180 45'/></joint>"
      "<joint name='turn'><origin rpy='6.2832 -6.29 0'/></joint></robot>");
  EXPECT_THAT(WideAngles(file),
              testing::ElementsAre("joint j by -180 rad",
                                   "the inertia of link a by 90 rad"));
}

TEST(UrdfReader, PandaAgreesWithItsDhTable) {
  if (!std::filesystem::exists(Shared("panda/robot.urdf"))) {
    GTEST_SKIP() << "no " << Shared("panda/robot.urdf");
  }
  const Robot robot = ReadRobot(Shared("panda/robot.urdf"), {});
  ASSERT_EQ(robot.num_joints(), 7);
  EXPECT_THAT(robot.notes, IsEmpty());
  const double rows[7][3] = {
      {0, 0, 0.333},         {-kQuarter, 0, 0},           {kQuarter, 0, 0.316},
      {kQuarter, 0.0825, 0}, {-kQuarter, -0.0825, 0.384}, {kQuarter, 0, 0},
      {kQuarter, 0.088, 0}};  // alpha, a, d
  Eigen::VectorXd q(7);
  q << 0.3, -0.8, 1.2, -2.0, 0.4, 1.9, -0.6;
  Isometry3d X = Isometry3d::Identity();
  for (int i = 0; i < 7; ++i) {
    X = X * AngleAxisd(rows[i][0], Vector3d::UnitX()) *
        Translation3d(rows[i][1], 0, 0) * AngleAxisd(q[i], Vector3d::UnitZ()) *
        Translation3d(0, 0, rows[i][2]);
  }
  EXPECT_TRUE(Tip(robot, q).isApprox(X, 1e-8));
}

TEST(UrdfReader, Ur10eWithFixedLinksAtBothEnds) {
  if (!std::filesystem::exists(Shared("ur10e_free/robot.urdf"))) {
    GTEST_SKIP() << "no " << Shared("ur10e_free/robot.urdf");
  }
  RobotReaderOptions options;
  options.tip = "tool0";
  const Robot robot = ReadRobot(Shared("ur10e_free/robot.urdf"), options);
  EXPECT_THAT(
      robot.JointNames(),
      ElementsAre("shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint",
                  "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"));
  // Stretched out along x at q = 0: the sums of the file's lengths.
  const Vector3d p = Tip(robot, Eigen::VectorXd::Zero(6)).translation();
  EXPECT_NEAR(p.x(), 0.613 + 0.571, 1e-9);
  EXPECT_NEAR(p.y(), 0.176 - 0.137 + 0.135 + 0.117, 1e-9);
  EXPECT_NEAR(p.z(), 0.181 - 0.12, 1e-9);
}

}  // namespace armcal::urdf_reader_test
