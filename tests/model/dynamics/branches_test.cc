// Robots that branch: all engines agree with recursive Newton-Euler over the
// tree, which agrees with Simbody (tests/model/plant/simbody_arm_test.cc).
#include <gtest/gtest.h>

#include <algorithm>

#include "model/dynamics/base_inertials.h"
#include "model/dynamics/batch_forward_dynamics.h"
#include "model/dynamics/batch_inverse_dynamics.h"
#include "model/dynamics/batch_regressor.h"
#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/geometry_jacobian.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/dynamics/link_regressor.h"
#include "model/dynamics/model_parameters.h"
#include "model/dynamics/rigid_arm.h"
#include "model/robot/kinematics.h"
#include "tests/fixtures/random_motion.h"
#include "tests/model/dynamics/dual_regressor.h"

namespace armcal::branches_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kTrials = 30;

double Error(const MatrixXd& value, const MatrixXd& truth) {
  return (value - truth).cwiseAbs().maxCoeff() /
         std::max(1., truth.cwiseAbs().maxCoeff());
}

// Calls test(robot, motion) with robots of 1 to 9 joints.
template <class Test>
void ForRobots(const Test& test) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Robot robot = RandomTree(2 + trial % 8, trial, &random);
    const int count = kCounts[trial % 3];
    SCOPED_TRACE(trial);
    test(robot, RandomMotion(&random, count, robot.num_joints(), 0));
  }
}

MatrixXd Torques(const Robot& robot, const RandomMotion& m) {
  MatrixXd tau(m.q.rows(), m.q.cols());
  for (int s = 0; s < m.q.rows(); ++s) {
    tau.row(s) = InverseDynamics(robot, m.q.row(s), m.qd.row(s), m.qdd.row(s));
  }
  return tau;
}

std::vector<double*> Columns(MatrixXd& m) {
  std::vector<double*> to;
  for (int j = 0; j < m.cols(); ++j) to.push_back(m.col(j).data());
  return to;
}

TEST(Branches, PathsAndBranches) {
  //   0 - 1 - 2        6 - 7
  //     |   |
  //     |   3 - 4
  //     5
  const LinkParents parents = {-1, 0, 1, 1, 3, 0, -1, 6};
  EXPECT_EQ(TipsOf(parents, 8), (std::vector<int>{2, 4, 5, 7}));
  EXPECT_EQ(EndOfBranch(parents, 0, 8), 6);
  EXPECT_EQ(EndOfBranch(parents, 1, 8), 5);
  EXPECT_TRUE(Moves(parents, 1, 4));
  EXPECT_FALSE(Moves(parents, 2, 3));
  EXPECT_FALSE(Moves(parents, 4, 3));
  const auto paths = PathsOf(parents, 8);
  ASSERT_EQ(paths.size(), 4u);
  EXPECT_EQ(paths[1].links, (std::vector<int>{0, 1, 3, 4}));
  EXPECT_EQ(paths[1].first_own, 2);
  EXPECT_EQ(paths[3].links, (std::vector<int>{6, 7}));
  EXPECT_EQ(paths[3].first_own, 0);
  EXPECT_EQ(PathsOf({}, 3).size(), 1u);
}

TEST(Branches, BatchesOfTorques) {
  ForRobots([](const Robot& robot, const RandomMotion& m) {
    MatrixXd tau(m.q.rows(), m.q.cols());
    BatchInverseDynamics(robot).Torque(m.columns(), m.q.rows(),
                                       Columns(tau).data());
    EXPECT_LT(Error(tau, Torques(robot, m)), 1e-11);
  });
}

// M(q) qdd + bias is the torque, and M is also the difference of torques.
TEST(Branches, MassMatrix) {
  ForRobots([](const Robot& robot, const RandomMotion& m) {
    const VectorXd q = m.q.row(0), qd = m.qd.row(0), qdd = m.qdd.row(0);
    ArmTerms terms;
    RigidArm(robot).Evaluate(q, qd, {}, &terms);
    const VectorXd tau = terms.mass_matrix * qdd + terms.bias;
    EXPECT_LT(Error(tau, InverseDynamics(robot, q, qd, qdd)), 1e-11);
    EXPECT_LT(Error(MassMatrix(robot, q), terms.mass_matrix), 1e-12);
    Robot driven = robot;
    for (Link& link : driven.links) link.joint.armature = .1;
    MatrixXd found(m.q.rows(), m.q.cols());
    const MatrixXd torque = Torques(robot, m) + .1 * m.qdd;
    BatchForwardDynamics(driven).Acceleration(m.q, m.qd, torque, &found);
    EXPECT_LT(Error(found, m.qdd), 1e-8);
  });
}

// dE/dt is the power of the torque.
TEST(Branches, Energy) {
  ForRobots([](const Robot& robot, const RandomMotion& m) {
    const VectorXd q = m.q.row(0), qd = m.qd.row(0), qdd = m.qdd.row(0);
    const double h = 1e-5;
    const auto energy = [&](double t) {
      const ArmEnergy e =
          Energy(robot, q + t * qd + t * t / 2 * qdd, qd + t * qdd);
      return e.kinetic + e.potential;
    };
    const double power = qd.dot(InverseDynamics(robot, q, qd, qdd));
    EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h), power,
                1e-6 * (1 + std::abs(power)));
  });
}

TEST(Branches, LinkRegressors) {
  ForRobots([](const Robot& robot, const RandomMotion& m) {
    const int n = robot.num_joints();
    VectorXd V(10 * n);
    for (int i = 0; i < n; ++i) {
      V.segment<10>(10 * i) = robot.links[i].inertial.ToVector();
    }
    const BatchRegressor batch(robot);
    std::vector<MatrixXd> U;
    std::vector<double*> out;
    for (int i = 0; i < n; ++i) {
      U.push_back(MatrixXd::Constant(m.q.rows(), batch.row_size(i), 777));
    }
    for (MatrixXd& rows : U) out.push_back(rows.data());
    batch.Differential(m.columns(), m.q.rows(), out.data(), m.q.rows());
    const MatrixXd tau = Torques(robot, m);
    for (int i = 0; i < n; ++i) {
      EXPECT_LT(Error(U[i] * V.tail(10 * (n - i)), tau.col(i)), 1e-11);
    }
    LinkRegressor single(robot);
    MatrixXd P, D;
    VectorXd PV, DV;
    const VectorXd q = m.q.row(0), qd = m.qd.row(0);
    single.Momentum(q, qd, &P, &D);
    single.Momentum(q, qd, V, &PV, &DV);
    EXPECT_LT(Error(P * V, PV), 1e-11);
    EXPECT_LT(Error(D * V, DV), 1e-11);
    EXPECT_LT(Error(PV, MassMatrix(robot, q) * qd), 1e-11);
  });
}

ModelParameters Model(const Robot& robot, GeometryKnowledge geometry) {
  ModelParameters::Options options;
  options.geometry = geometry;
  return ModelParameters(robot, options);
}

// tau = U X, of one sample and of many, and of the automatic differentiation;
// also with lengths unknown, for a robot of other ones.
TEST(Branches, ModelParameters) {
  for (const auto geometry :
       {GeometryKnowledge::kKnown, GeometryKnowledge::kAllLengths}) {
    ForRobots([geometry](const Robot& robot, const RandomMotion& m) {
      const ModelParameters model = Model(robot, geometry);
      Regressor regressor = model.MakeRegressor();
      const DualRegressor dual(model, m, 0);
      MatrixXd U, P, D;
      const VectorXd q = m.q.row(0), qd = m.qd.row(0), qdd = m.qdd.row(0);
      regressor.Differential(q, qd, qdd, {}, &U);
      const VectorXd tau = InverseDynamics(robot, q, qd, qdd);
      EXPECT_LT(Error(U * model.nominal(), tau), 1e-10);
      EXPECT_LT(Error(U, dual.U), 1e-10);
      regressor.Momentum(q, qd, {}, &P, &D);
      EXPECT_LT(Error(D, dual.D), 1e-10);
      EXPECT_LT(Error(P * model.nominal(), MassMatrix(robot, q) * qd), 1e-10);
      const BatchRegressor batch(model);
      for (int i = 0; i < robot.num_joints(); ++i) {
        const auto& columns = model.row_columns(i);
        ASSERT_EQ(batch.row_size(i), static_cast<int>(columns.size()));
        for (int c = 0; c < model.size(); ++c) {
          const bool in_row =
              std::find(columns.begin(), columns.end(), c) != columns.end();
          if (!in_row) EXPECT_EQ(U(i, c), 0);
        }
      }
    });
  }
}

// As many model parameters as there are base inertial parameters.
TEST(Branches, NumberOfParameters) {
  ForRobots([](const Robot& robot, const RandomMotion&) {
    EXPECT_EQ(Model(robot, GeometryKnowledge::kKnown).size(),
              static_cast<int>(BaseInertials(robot).columns.size()));
  });
}

// Derivatives by the geometry, against differences.
TEST(Branches, GeometryJacobian) {
  ForRobots([](const Robot& robot, const RandomMotion& m) {
    ArmGeometry geometry(robot);
    std::vector<int> all;
    for (int k = 0; k < geometry.size(); ++k) all.push_back(k);
    const GeometryJacobian jacobian(robot, geometry, all);
    const VectorXd q = m.q.row(0), qd = m.qd.row(0), qdd = m.qdd.row(0);
    const MatrixXd J = jacobian.Torque(q, qd, qdd);
    const VectorXd values = geometry.Values();
    MatrixXd differences(J.rows(), J.cols());
    const double h = 1e-6;
    for (int k = 0; k < geometry.size(); ++k) {
      const auto torque = [&](double change) {
        geometry.SetValues(values + change * VectorXd::Unit(values.size(), k));
        return InverseDynamics(geometry.ApplyTo(robot), q, qd, qdd);
      };
      differences.col(k) = (torque(h) - torque(-h)) / (2 * h);
    }
    EXPECT_LT(Error(J, differences), 1e-6);
    geometry.SetValues(values);
    const int n = robot.num_joints(), count = static_cast<int>(m.q.rows());
    std::vector<MatrixXd> rows(n, MatrixXd(count, geometry.size()));
    std::vector<double*> out;
    for (MatrixXd& row : rows) out.push_back(row.data());
    jacobian.Torque(m.columns(), count, out.data(), count);
    for (int i = 0; i < n; ++i) {
      EXPECT_LT(Error(rows[i].row(0), J.row(i)), 1e-12);
    }
  });
}

}  // namespace armcal::branches_test
