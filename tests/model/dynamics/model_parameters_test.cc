#include "model/dynamics/model_parameters.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "model/dynamics/inverse_dynamics.h"
#include "model/signals/dense_solvers.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::model_parameters_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

nlohmann::json Gold() {
  std::ifstream file(SHARED_DIR "/gold.json");
  return file ? nlohmann::json::parse(file) : nlohmann::json();
}

ModelParameters Make(const Robot& robot, GeometryKnowledge geometry,
                     const std::vector<JointTerm>& terms = {}) {
  ModelParameters::Options options;
  options.geometry = geometry;
  options.joint_terms = terms;
  options.transitions.assign(robot.links.size(), {CoulombTransition()});
  return ModelParameters(robot, options);
}

std::vector<int> BlockSizes(const ModelParameters& parameters) {
  std::vector<int> sizes;
  for (int i = 0; i < parameters.num_joints(); ++i) {
    sizes.push_back(parameters.block_size(i));
  }
  return sizes;
}

// The paper's arm: links 1, 3, 4 symmetric about z.
Robot PaperScara() {
  Robot robot = SampleRobot("SCARA RRPR");
  for (const int i : {0, 2, 3}) robot.links[i].zero_inertials = {"hx", "hy"};
  return robot;
}

TEST(ModelParameters, CountsMatchGold) {
  const auto gold = Gold();
  if (gold.is_null()) GTEST_SKIP() << "shared/gold.json is absent";
  for (const auto& [name, cases] : gold["counts"].items()) {
    const Robot robot = SampleRobot(name);
    const auto sizes = [&](GeometryKnowledge g) {
      return BlockSizes(Make(robot, g));
    };
    EXPECT_EQ(sizes(GeometryKnowledge::kKnown), cases["c"]) << name;
    EXPECT_EQ(sizes(GeometryKnowledge::kNonzeroLengths), cases["b2"]) << name;
    EXPECT_EQ(sizes(GeometryKnowledge::kAllLengths), cases["b1"]) << name;
  }
}

TEST(ModelParameters, TorquesMatchGold) {
  const auto gold = Gold();
  if (gold.is_null()) GTEST_SKIP() << "shared/gold.json is absent";
  for (const auto& [name, g] : gold["torque_gold"].items()) {
    Robot robot = SampleRobot(name);
    for (int i = 0; i < robot.num_joints(); ++i) {
      Eigen::Matrix3d I;
      I << .05, .002, .004, .002, .06, -.002, .004, -.002, .04;
      robot.links[i].inertial = InertialParameters::FromCenterOfMass(
          5 - .5 * i, {.02 * (i + 1), -.01 * (i + 1), .05 - .01 * i},
          I / (i + 1));
    }
    const auto vector = [&g = g](const char* key) {
      const std::vector<double> v = g[key];
      return VectorXd(Eigen::Map<const VectorXd>(v.data(), v.size()));
    };
    const VectorXd q = vector("q"), qd = vector("qd"), qdd = vector("qdd");
    const VectorXd tau = vector("tau_rnea");
    EXPECT_LT((InverseDynamics(robot, q, qd, qdd) - tau).cwiseAbs().maxCoeff(),
              1e-10)
        << name;
    for (const auto geometry :
         {GeometryKnowledge::kKnown, GeometryKnowledge::kNonzeroLengths}) {
      const ModelParameters parameters = Make(robot, geometry);
      MatrixXd U;
      parameters.MakeRegressor().Differential(q, qd, qdd, VectorXd(), &U);
      EXPECT_LT((U * parameters.Values(robot) - tau).cwiseAbs().maxCoeff(),
                1e-10)
          << name;
    }
  }
}

// (3.14)-(3.16) with the misprints of (3.15) corrected, in the order
// X11 | X21 X22 X23 | X31 | X41.
TEST(ModelParameters, PaperScaraEquations) {
  const double g = 9.8, a1 = .4;
  ModelParameters parameters =
      Make(PaperScara(), GeometryKnowledge::kNonzeroLengths);
  EXPECT_EQ(BlockSizes(parameters), (std::vector<int>{1, 3, 1, 1}));
  Regressor regressor = parameters.MakeRegressor();
  std::mt19937_64 random(1);
  for (int s = 0; s < 100; ++s) {
    const VectorXd q = UniformVector(&random, 4, -3, 3);
    const VectorXd v = UniformVector(&random, 4, -3, 3);
    const VectorXd a = UniformVector(&random, 4, -3, 3);
    const double S = std::sin(q[1]), C = std::cos(q[1]);
    const double v1 = v[0], v2 = v[1];
    MatrixXd expected(4, 6), P_expected(4, 6), D_expected(4, 6), U, P, D;
    expected << a[0], a[1], (2 * a[0] + a[1]) * C - (2 * v1 * v2 + v2 * v2) * S,
        -(2 * a[0] + a[1]) * S - (2 * v1 * v2 + v2 * v2) * C, 0, a[3],  //
        0, a[0] + a[1], a[0] * C + v1 * v1 * S, -a[0] * S + v1 * v1 * C, 0,
        a[3],                     //
        0, 0, 0, 0, a[2] - g, 0,  //
        0, 0, 0, 0, 0, a[0] + a[1] + a[3];
    P_expected << v1, v2, (2 * v1 + v2) * C, -(2 * v1 + v2) * S, 0, v[3],  //
        0, v1 + v2, v1 * C, -v1 * S, 0, v[3],                              //
        0, 0, 0, 0, v[2], 0,                                               //
        0, 0, 0, 0, 0, v1 + v2 + v[3];
    D_expected << 0, 0, 0, 0, 0, 0,                                      //
        0, 0, -(v1 * v2 + v1 * v1) * S, -(v1 * v2 + v1 * v1) * C, 0, 0,  //
        0, 0, 0, 0, g, 0,                                                //
        0, 0, 0, 0, 0, 0;
    regressor.Differential(q, v, a, VectorXd(), &U);
    regressor.Momentum(q, v, VectorXd(), &P, &D);
    EXPECT_LT((U - expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((P - P_expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((D - D_expected).cwiseAbs().maxCoeff(), 1e-12);
  }
  EXPECT_EQ(parameters.parameters()[2].name, "a1*hx[2]");
  (void)a1;
}

// X of (3.12) from masses, centres and inertias.
TEST(ModelParameters, PaperScaraValues) {
  Robot robot = PaperScara();
  const double a1 = .4, a2 = .3, x2 = -.08, y2 = .05;
  const double m[] = {6, 5, 2, 1}, Izz[] = {.3, .2, .04, .01};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d com =
        i == 1 ? Eigen::Vector3d(x2, y2, .03) : Eigen::Vector3d(0, 0, .02);
    // The paper's I2zz is about the link's origin.
    const double about_com =
        Izz[i] - m[i] * (com.x() * com.x() + com.y() * com.y());
    robot.links[i].inertial = InertialParameters::FromCenterOfMass(
        m[i], com, Eigen::Vector3d(.1, .1, about_com).asDiagonal());
  }
  const VectorXd X =
      Make(robot, GeometryKnowledge::kNonzeroLengths).Values(robot);
  const double X21 = Izz[1] + m[1] * a2 * a2 + 2 * m[1] * x2 * a2 + Izz[2] +
                     m[2] * a2 * a2 + Izz[3] + m[3] * a2 * a2;
  VectorXd expected(6);
  expected << X21 + Izz[0] + (m[0] + m[1] + m[2] + m[3]) * a1 * a1, X21,
      m[1] * a1 * a2 + m[1] * x2 * a1 + (m[2] + m[3]) * a1 * a2, m[1] * y2 * a1,
      m[2] + m[3], Izz[3];
  EXPECT_LT((X - expected).cwiseAbs().maxCoeff(), 1e-12) << X.transpose();
}

// Requirements of the structure theorem on arms nobody has tuned for: torque
// from X(V, W) against Newton-Euler, block triangle, rank, d/dt P - D = U.
TEST(ModelParameters, RandomChains) {
  std::mt19937_64 random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + trial % 7;
    Robot robot = RandomArm(n, &random);
    SetRandomInertials(&random, &robot);
    for (Link& link : robot.links) {
      for (const char* symbol : {"a", "d"}) {
        if (Uniform(&random, 0, 1) < .5) {
          link.unknown_lengths.push_back(symbol);
        }
      }
    }
    const ModelParameters parameters =
        Make(robot, GeometryKnowledge::kDeclaredLengths);
    Regressor regressor = parameters.MakeRegressor();
    const VectorXd X = parameters.Values(robot);
    const int m = parameters.size();
    const int samples = std::max(60, 3 * m / n + 30);
    MatrixXd A(samples * n, m), U, P, D, P1, D1;
    double error = 0, scale = 0;
    for (int s = 0; s < samples; ++s) {
      const VectorXd q = UniformVector(&random, n, -2, 2);
      const VectorXd qd = UniformVector(&random, n, -2, 2);
      const VectorXd qdd = UniformVector(&random, n, -2, 2);
      regressor.Differential(q, qd, qdd, VectorXd(), &U);
      A.middleRows(s * n, n) = U;
      const VectorXd tau = InverseDynamics(robot, q, qd, qdd);
      error = std::max(error, (U * X - tau).cwiseAbs().maxCoeff());
      scale = std::max(scale, tau.cwiseAbs().maxCoeff());
      for (int i = 0; i < n; ++i) {
        for (int k = i + 1; k < n; ++k) {
          ASSERT_EQ(
              U.block(k, parameters.block_begin(i), 1, parameters.block_size(i))
                  .cwiseAbs()
                  .sum(),
              0);
        }
      }
      const double e = 1e-4;
      regressor.Momentum(q + e * qd + e * e / 2 * qdd, qd + e * qdd, VectorXd(),
                         &P1, &D1);
      regressor.Momentum(q - e * qd + e * e / 2 * qdd, qd - e * qdd, VectorXd(),
                         &P, &D);
      const MatrixXd rate = (P1 - P) / (2 * e);
      regressor.Momentum(q, qd, VectorXd(), &P, &D);
      ASSERT_LT((rate - D - U).cwiseAbs().maxCoeff(),
                1e-6 * std::max(1.0, U.cwiseAbs().maxCoeff()));
    }
    EXPECT_LE(error, 1e-11 * scale) << "trial " << trial << ", " << n << " dof";
    A.array().rowwise() /= A.colwise().norm().array().eval();
    const VectorXd s = A.jacobiSvd().singularValues();
    EXPECT_GT(s[m - 1], 1e-8 * s[0]) << "rank below m = " << m;
  }
}

// Rotors of joint 1, and of joint 2 where its axis is perpendicular to joint
// 1's, are Izz[1] and Izz[2]: their energies are of one form, qd^2.
TEST(ModelParameters, ArmatureOfTheFirstJointsIsMerged) {
  for (const char* name : {"PUMA560 6R", "UR5 6R", "Panda 7R"}) {
    const ModelParameters parameters =
        Make(SampleRobot(name), GeometryKnowledge::kKnown,
             {JointTerm::kViscous, JointTerm::kCoulomb, JointTerm::kOffset,
              JointTerm::kArmature});
    ASSERT_EQ(parameters.merged().size(), 2) << name;
    EXPECT_EQ(parameters.parameters()[0].name, "Izz[1] + armature[1]");
    EXPECT_EQ(parameters.merged()[0],
              "armature[1] cannot be told from Izz[1]: they are one parameter");
  }
}

TEST(ModelParameters, JointTermsAddTheirTorque) {
  Robot robot = SampleRobot("UR5 6R");
  std::mt19937_64 random(3);
  SetRandomInertials(&random, &robot);
  const ModelParameters parameters =
      Make(robot, GeometryKnowledge::kKnown,
           {JointTerm::kViscous, JointTerm::kCoulomb, JointTerm::kOffset,
            JointTerm::kArmature});
  for (Link& link : robot.links) {
    link.joint.viscous = Uniform(&random, 1, 2);
    link.joint.coulomb = Uniform(&random, 1, 2);
    link.joint.armature = Uniform(&random, 1, 2);
  }
  const VectorXd q = UniformVector(&random, 6, -2, 2);
  const VectorXd qd = UniformVector(&random, 6, -.2, .2);
  const VectorXd qdd = UniformVector(&random, 6, -2, 2);
  VectorXd tau = InverseDynamics(robot, q, qd, qdd);
  for (int i = 0; i < 6; ++i) {
    const Joint& j = robot.links[i].joint;
    tau[i] += j.viscous * qd[i] + j.armature * qdd[i];
  }
  MatrixXd U;
  const VectorXd coulomb = UniformVector(&random, 6, -1, 1);
  parameters.MakeRegressor().Differential(q, qd, qdd, coulomb, &U);
  for (int i = 0; i < 6; ++i) {
    tau[i] += robot.links[i].joint.coulomb * coulomb[i];
  }
  EXPECT_LT((U * parameters.Values(robot) - tau).cwiseAbs().maxCoeff(), 1e-11);
}

}  // namespace armcal::model_parameters_test
