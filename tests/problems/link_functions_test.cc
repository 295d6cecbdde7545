#include "problems/link_functions.h"

#include <gtest/gtest.h>

#include <numeric>

#include "model/dynamics/inverse_dynamics.h"
#include "model/dynamics/link_regressor.h"
#include "problems/make_rows.h"
#include "problems/weak_rows.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::link_functions_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<int> All(const ArmGeometry& geometry) {
  std::vector<int> all(geometry.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

Robot MakeRobot(const std::string& name, std::mt19937_64* random) {
  Robot robot = SampleRobot(name);
  SetRandomInertials(random, &robot);
  return robot;
}

Robot Changed(const Robot& robot, int parameter, double by) {
  ArmGeometry geometry(robot);
  VectorXd g = geometry.Values();
  g[parameter] += by;
  geometry.SetValues(g);
  return geometry.ApplyTo(robot);
}

Trajectory Record(const Robot& robot, std::mt19937_64* random) {
  Log log = RecordMotion(RandomMultisine(random, robot.num_joints()), 2, .002);
  AddTorque(robot, &log);
  return MakeTrajectory(log);
}

std::vector<IdentificationRow> RowsOf(const Trajectory& trajectory,
                                      LinkFunctions* functions) {
  std::vector<IdentificationRow> rows;
  functions->Enter(trajectory);
  const WeakRows weak(trajectory, RowOptions(), *functions);
  ForEachRow(weak, *functions,
             [&](const IdentificationRow& row) { rows.push_back(row); });
  return rows;
}

// P and D of one sample.
std::pair<MatrixXd, MatrixXd> DenseMomentum(const LinkFunctions& functions,
                                            int sample) {
  JointColumns P, D;
  P.Resize(RowSizes(functions, 0), 1);
  D.Resize(RowSizes(functions, 0), 1);
  functions.Momentum(sample, 1, P.data(), D.data(), P.stride());
  const auto& columns = functions.row_columns();
  MatrixXd dense_P = MatrixXd::Zero(columns.size(), functions.size());
  MatrixXd dense_D = dense_P;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    for (int c = 0; c < static_cast<int>(columns[i].size()); ++c) {
      dense_P(i, columns[i][c]) = *P.column(i, c);
      dense_D(i, columns[i][c]) = *D.column(i, c);
    }
  }
  return {dense_P, dense_D};
}

TEST(LinkFunctions, ColumnsOfLinksAndTerms) {
  std::mt19937_64 random(1);
  const Robot robot = MakeRobot("PUMA560 6R", &random);
  const Trajectory trajectory = Record(robot, &random);
  const std::vector<JointTermColumn> terms = {{1, JointTerm::kViscous, {}},
                                              {4, JointTerm::kOffset, {}},
                                              {2, JointTerm::kArmature, {}}};
  const ArmGeometry geometry(robot);
  LinkFunctions functions(robot, terms, geometry, {7, 9});
  ASSERT_EQ(functions.size(), 65);
  functions.Enter(trajectory);
  LinkRegressor regressor(robot);
  for (const int k : {0, 100, 1000}) {
    MatrixXd P_links, D_links;
    const auto [P, D] = DenseMomentum(functions, k);
    const VectorXd q = trajectory.q.row(k), qd = trajectory.qd.row(k);
    regressor.Momentum(q, qd, &P_links, &D_links);
    EXPECT_LT((P.leftCols(60) - P_links).norm(), 1e-12);
    EXPECT_LT((D.leftCols(60) - D_links).norm(), 1e-12);
    MatrixXd P_terms = MatrixXd::Zero(6, 3), D_terms = P_terms;
    D_terms(1, 0) = -qd[1];
    D_terms(4, 1) = -1;
    P_terms(2, 2) = qd[2];
    EXPECT_EQ(P.middleCols(60, 3), P_terms);
    EXPECT_EQ(D.middleCols(60, 3), D_terms);
  }
}

// The torque itself, by Newton and Euler and by the terms' own law; columns of
// the geometry are those of its Jacobian.
TEST(LinkFunctions, DifferentialColumnsAreOfTheTorque) {
  std::mt19937_64 random(6);
  const Robot robot = MakeRobot("PUMA560 6R", &random);
  Trajectory trajectory = Record(robot, &random);
  const std::vector<JointTermColumn> terms = {{1, JointTerm::kCoulomb, {}},
                                              {4, JointTerm::kOffset, {}},
                                              {1, JointTerm::kArmature, {}}};
  const ArmGeometry geometry(robot);
  LinkFunctions functions(robot, terms, geometry, {9, 7});
  functions.Enter(trajectory);
  const Eigen::MatrixXd states = CoulombStates(terms).Follow(trajectory);
  const int k = 300;
  JointColumns columns;
  columns.Resize(RowSizes(functions, 0), 1);
  functions.Differential(k, 1, columns.data(), columns.stride());
  MatrixXd U = MatrixXd::Zero(6, functions.size());
  for (int i = 0; i < 6; ++i) {
    const auto& used = functions.row_columns()[i];
    for (size_t c = 0; c < used.size(); ++c) {
      U(i, used[c]) = *columns.column(i, static_cast<int>(c));
    }
  }
  const VectorXd q = trajectory.q.row(k), qd = trajectory.qd.row(k),
                 qdd = trajectory.qdd.row(k);
  const VectorXd tau = InverseDynamics(robot, q, qd, qdd);
  EXPECT_LT((U.leftCols(60) * StackInertials(robot) - tau).norm(),
            1e-12 * tau.norm());
  MatrixXd of_terms = MatrixXd::Zero(6, 3);
  of_terms(1, 0) = states(k, 0);
  of_terms(4, 1) = 1;
  of_terms(1, 2) = qdd[1];
  EXPECT_EQ(U.middleCols(60, 3), of_terms);
  const MatrixXd J =
      GeometryJacobian(robot, geometry, {9, 7}).Torque(q, qd, qdd);
  EXPECT_LT((U.rightCols(2) - J).norm(), 1e-12 * J.norm());
}

TEST(LinkFunctions, StackInertialsInOrder) {
  std::mt19937_64 random(2);
  const Robot robot = MakeRobot("UR5 6R", &random);
  const VectorXd V = StackInertials(robot);
  ASSERT_EQ(V.size(), 60);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(V[10 * i], robot.links[i].inertial.mass);
    EXPECT_EQ(V[10 * i + 9], robot.links[i].inertial.inertia(2, 2));
  }
}

// On an analytic motion the inertias give Newton-Euler's torque, and a column
// of the geometry the change of that torque: the robot is changed and its
// torque computed anew, by other code and with another step.
TEST(LinkFunctions, WeakRowsGiveTorqueAndItsChange) {
  std::mt19937_64 random(3);
  for (const std::string name : {"PUMA560 6R", "SCARA RRPR", "Panda 7R"}) {
    Robot robot = MakeRobot(name, &random);
    if (name == "Panda 7R") robot.dh_convention.reset();  // URDF's parameters
    const ArmGeometry geometry(robot);
    const int n = robot.num_joints(), links = 10 * n;
    LinkFunctions functions(robot, {}, geometry, All(geometry));
    LinkFunctions no_geometry(robot, {}, geometry, {});
    Trajectory trajectory = Record(robot, &random);
    const VectorXd V = StackInertials(robot);
    const double size = ColumnRms(trajectory.tau).maxCoeff();
    const auto rows = RowsOf(trajectory, &functions);
    ASSERT_GT(rows.size(), 8);
    for (const auto& row : rows) {
      EXPECT_LT((row.U.leftCols(links) * V - row.Y).norm(), 1e-5 * size);
    }
    for (int p = 0; p < geometry.size(); ++p) {
      const double e = 1e-4;
      Trajectory change = trajectory;
      const Robot plus = Changed(robot, p, e), minus = Changed(robot, p, -e);
      for (int k = 0; k < change.size(); ++k) {
        const VectorXd q = change.q.row(k), qd = change.qd.row(k),
                       qdd = change.qdd.row(k);
        change.tau.row(k) = (InverseDynamics(plus, q, qd, qdd) -
                             InverseDynamics(minus, q, qd, qdd)) /
                            (2 * e);
      }
      // Only mean torques are wanted of this.
      const auto changes = RowsOf(change, &no_geometry);
      ASSERT_EQ(changes.size(), rows.size());
      for (size_t k = 0; k < rows.size(); ++k) {
        EXPECT_LT((rows[k].U.col(links + p) - changes[k].Y).norm(), 1e-5 * size)
            << name << " " << geometry.Names()[p];
      }
    }
  }
}

// What a tool or the base's position is does not reach the torque; the base's
// tilt does through gravity.
TEST(LinkFunctions, ColumnsOfFramesBesideTheArm) {
  std::mt19937_64 random(4);
  const Robot robot = MakeRobot("3R elbow", &random);
  const ArmGeometry geometry(robot);
  LinkFunctions functions(robot, {}, geometry, All(geometry));
  const auto rows = RowsOf(Record(robot, &random), &functions);
  for (int p = 0; p < geometry.size(); ++p) {
    const std::string name = geometry.Names()[p];
    double largest = 0;
    for (const auto& row : rows) {
      largest = std::max(largest, row.U.col(30 + p).norm());
    }
    const bool tilt = name == "base.pitch" || name == "base.roll";
    const bool base = name.compare(0, 5, "base.") == 0;
    if (tilt) {
      EXPECT_GT(largest, 1) << name;
    } else if (base) {
      EXPECT_LT(largest, 1e-6) << name;
    } else if (name.compare(0, 5, "tool.") == 0) {
      EXPECT_EQ(largest, 0) << name;
    }
  }
}

TEST(LinkFunctions, StandstillIsUselessOnlyWithCoulombFriction) {
  std::mt19937_64 random(5);
  const Robot robot = MakeRobot("3R elbow", &random);
  Trajectory trajectory = Record(robot, &random);
  trajectory.standstill[5] = true;
  for (const bool friction : {false, true}) {
    std::vector<JointTermColumn> terms;
    if (friction) terms.push_back({0, JointTerm::kCoulomb, {}});
    LinkFunctions functions(robot, terms, ArmGeometry(robot), {});
    functions.Enter(trajectory);
    EXPECT_EQ(functions.Useless(5), friction);
    EXPECT_FALSE(functions.Useless(6));
  }
}

}  // namespace armcal::link_functions_test
