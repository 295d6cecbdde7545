#include "model/dynamics/proximal_chain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/dynamics/inverse_dynamics.h"
#include "model/dynamics/model_parameters.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::proximal_chain_test {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979323846;
constexpr auto kBoth = {GeometryKnowledge::kKnown,
                        GeometryKnowledge::kAllLengths};

Isometry3d RandomPose(std::mt19937_64* random) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = RotationFromRpy(UniformVector(random, 3, -3, 3));
  X.translation() = UniformVector(random, 3, -.5, .5);
  return X;
}

// Largest error of the torque from the parameters of `values` in the regressor
// of `structure`, over the largest torque.
double TorqueError(const Robot& structure, const Robot& values,
                   GeometryKnowledge geometry) {
  ModelParameters::Options options;
  options.geometry = geometry;
  const ModelParameters parameters(structure, options);
  Regressor regressor = parameters.MakeRegressor();
  const VectorXd X = parameters.Values(values);
  const int n = values.num_joints();
  std::mt19937_64 random(11);
  double error = 0, scale = 0;
  Eigen::MatrixXd U;
  for (int s = 0; s < 40; ++s) {
    const VectorXd q = UniformVector(&random, n, -3, 3);
    const VectorXd qd = UniformVector(&random, n, -2, 2);
    const VectorXd qdd = UniformVector(&random, n, -2, 2);
    const VectorXd tau = InverseDynamics(values, q, qd, qdd);
    regressor.Differential(q, qd, qdd, {}, &U);
    error = std::max(error, (U * X - tau).cwiseAbs().maxCoeff());
    scale = std::max(scale, tau.cwiseAbs().maxCoeff());
  }
  return error / scale;
}

// Links with frames anywhere, as URDF allows, whose joint axes lie to the
// previous one as `next_axis` says (in its frame M).
template <class NextAxis>
Robot UrdfArm(int n, std::mt19937_64* random, const NextAxis& next_axis) {
  Robot robot;
  robot.gravity = UniformVector(random, 3, -9, 9);
  Isometry3d X_ML = Isometry3d::Identity();
  for (int i = 0; i < n; ++i) {
    Link link;
    const bool slides = i != 0 && Uniform(random, 0, 1) < .25;
    if (slides) link.joint.type = JointType::kPrismatic;
    Isometry3d X_MF = RandomPose(random);
    if (i > 0) X_MF = next_axis(X_MF);
    link.X_PF = X_ML.inverse() * X_MF;
    link.X_ML = X_ML = RandomPose(random);
    robot.links.push_back(link);
  }
  SetRandomInertials(random, &robot);
  return robot;
}

template <class NextAxis>
void ExpectTorques(const NextAxis& next_axis) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 6; ++trial) {
    const Robot robot = UrdfArm(2 + trial % 4, &random, next_axis);
    for (const GeometryKnowledge geometry : kBoth) {
      EXPECT_LT(TorqueError(robot, robot, geometry), 1e-11) << trial;
    }
  }
}

TEST(ProximalChain, AxesAnywhere) {
  ExpectTorques([](const Isometry3d& X_MF) { return X_MF; });
}

TEST(ProximalChain, ParallelAndAntiparallelAxes) {
  for (const double turn : {0.0, kPi}) {
    for (const double tilt :
         {0.0, 1e-15, 1e-13, 1e-6, 1e-3, .015, .0199, .0201, .03}) {
      SCOPED_TRACE(tilt);
      ExpectTorques([=](Isometry3d X_MF) {
        X_MF.linear() = (Eigen::AngleAxisd(.7, Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(turn + tilt, Vector3d(.6, .8, 0)) *
                         Eigen::AngleAxisd(-.4, Vector3d::UnitZ()))
                            .toRotationMatrix();
        return X_MF;
      });
    }
  }
}

TEST(ProximalChain, IntersectingAndCoaxialAxes) {
  ExpectTorques([](Isometry3d X_MF) {  // anywhere along the previous axis
    X_MF.translation().head<2>().setZero();
    return X_MF;
  });
  for (const double tilt : {0.0, 1e-6, kPi}) {
    for (const double offset : {0.0, 1e-12, 1e-10, 1e-7}) {
      ExpectTorques([=](Isometry3d X_MF) {
        X_MF.linear() = (Eigen::AngleAxisd(tilt, Vector3d::UnitY()) *
                         Eigen::AngleAxisd(1, Vector3d::UnitZ()))
                            .toRotationMatrix();
        X_MF.translation().head<2>() = Eigen::Vector2d(.6, .8) * offset;
        return X_MF;
      });
    }
  }
}

TEST(ProximalChain, KeepsDhTables) {
  for (const std::string& name : SampleRobotNames()) {
    const Robot robot = SampleRobot(name);
    const ProximalChain chain = MakeProximalChain(robot);
    EXPECT_EQ(chain.gravity, robot.gravity);
    for (const Length& length : chain.lengths) {
      const Vector3d p = robot.links[length.joint].X_ML.translation();
      EXPECT_NEAR(length.value, p[length.component], 1e-15) << length.name;
      EXPECT_EQ(length.owner_name,
                robot.links[length.joint].name + "." + length.name[0]);
    }
  }
}

// A negative a and an offset theta stay what the table says.
TEST(ProximalChain, KeepsNegativeLengthsAndOffsets) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 30; ++trial) {
    Robot robot;
    robot.links.resize(2);
    const VectorXd v = UniformVector(&random, 4, -1, 1);
    SetDhPose({v[0], v[1], 2 * v[2], 3 * v[3]}, DhConvention::kStandard,
              &robot.links[0]);
    const auto joints = MakeProximalChain(robot).joints;
    const Vector3d p = joints[1].X_JG.translation();
    EXPECT_LT((p - Vector3d(v[0], 0, v[1])).norm(), 1e-14);
    EXPECT_NEAR(joints[0].theta, 3 * v[3], 1e-14);
  }
}

// Franka's own (modified) table, flange excluded.
Robot ModifiedPanda() {
  const double a[] = {0, 0, 0, .0825, -.0825, 0, .088};
  const double d[] = {.333, 0, .316, 0, .384, 0, 0};
  const int quarter[] = {0, -1, 1, 1, -1, 1, 1};
  Robot robot;
  robot.dh_convention = DhConvention::kModified;
  for (int i = 0; i < 7; ++i) {
    Link link;
    link.name = "link" + std::to_string(i + 1);
    SetDhPose({a[i], d[i], quarter[i] * kPi / 2, 0}, DhConvention::kModified,
              &link);
    robot.links.push_back(link);
  }
  return robot;
}

TEST(ProximalChain, ModifiedTablesCountLikeStandardOnes) {
  Robot robot = ModifiedPanda();
  for (const auto geometry :
       {GeometryKnowledge::kKnown, GeometryKnowledge::kNonzeroLengths,
        GeometryKnowledge::kAllLengths}) {
    ModelParameters::Options options;
    options.geometry = geometry;
    const ModelParameters modified(robot, options);
    const ModelParameters standard(SampleRobot("Panda 7R"), options);
    for (int i = 0; i < 7; ++i) {
      EXPECT_EQ(modified.block_size(i), standard.block_size(i)) << i;
    }
  }
  const auto lengths = MakeProximalChain(robot).lengths;
  for (const Length& length : lengths) {
    if (length.name == "a4") {  // stands in row 5 of a modified table
      EXPECT_NEAR(length.value, -.0825, 1e-15);
      EXPECT_EQ(length.owner_name, "link5.a");
    }
  }
  std::mt19937_64 random(3);
  SetRandomInertials(&random, &robot);
  for (const GeometryKnowledge geometry : kBoth) {
    EXPECT_LT(TorqueError(robot, robot, geometry), 1e-11);
  }
}

// The parameters of an arm of other lengths, from the structure of this one;
// also lengths that change sign (2026-11-20: x turned with a's sign).
TEST(ProximalChain, OtherLengthsHaveTheSameStructure) {
  std::mt19937_64 random(6);
  const Robot puma = SampleRobot("PUMA560 6R");
  Robot urdf = UrdfArm(4, &random, [](const Isometry3d& X_MF) { return X_MF; });
  for (Link& link : urdf.links) link.joint.type = JointType::kRevolute;
  for (const Robot& robot : {puma, urdf}) {
    Robot other = robot;
    SetRandomInertials(&random, &other);
    const ProximalChain chain = MakeProximalChain(robot);
    for (int i = 0; i + 1 < robot.num_joints(); ++i) {
      const ProximalJoint& joint = chain.joints[i];  // the other a is -a
      const double a = chain.joints[i + 1].X_JG.translation().x();
      const Vector3d change(-2 * a, 0, Uniform(&random, -1, 1));
      other.links[i + 1].X_PF.pretranslate(joint.X_JL.linear().transpose() *
                                           change);
    }
    EXPECT_LT(TorqueError(robot, other, GeometryKnowledge::kAllLengths), 1e-11);
  }
}

}  // namespace armcal::proximal_chain_test
