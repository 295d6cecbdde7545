#include "model/batch_regressor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "model/batch_inverse_dynamics.h"
#include "model/inverse_dynamics.h"
#include "model/link_regressor.h"
#include "model/momentum_regressor.h"
#include "tests/sample_robots.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Motion {
  Motion(std::mt19937_64* random, int count, int n, int num_coulomb)
      : q(Random(random, count, n, 3)),
        qd(Random(random, count, n, 2)),
        qdd(Random(random, count, n, 5)),
        coulomb(Random(random, count, num_coulomb, 1)) {}
  static MatrixXd Random(std::mt19937_64* random, int rows, int cols,
                         double range) {
    MatrixXd x(rows, cols);
    for (int j = 0; j < cols; ++j) {
      x.col(j) = UniformVector(random, rows, -range, range);
    }
    return x;
  }
  MotionColumns columns() const { return {q, qd, qdd, coulomb}; }
  MatrixXd q, qd, qdd, coulomb;
};

// Rows of samples per joint, as a BatchRegressor writes them, with a margin
// that it must not write to.
class Rows {
 public:
  Rows(const BatchRegressor& regressor, int count)
      : count_(count), stride(count + 3) {
    for (int i = 0; i < regressor.num_joints(); ++i) {
      values_.push_back(
          MatrixXd::Constant(stride, regressor.row_size(i) + 1, kUntouched));
    }
    for (MatrixXd& rows : values_) pointers_.push_back(rows.data());
  }
  double* const* out() { return pointers_.data(); }
  double operator()(int joint, int sample, int column) const {
    return values_[joint](sample, column);
  }
  void ExpectMarginUntouched() const {
    for (const MatrixXd& rows : values_) {
      EXPECT_TRUE((rows.bottomRows(3).array() == kUntouched).all());
      EXPECT_TRUE((rows.rightCols(1).array() == kUntouched).all());
    }
  }

 private:
  static constexpr double kUntouched = 12345;
  int count_;
  std::vector<MatrixXd> values_;
  std::vector<double*> pointers_;

 public:
  const long stride;
};

// One sample's P, D and U of the model parameters by automatic differentiation.
struct DualNumbers {
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

  DualNumbers(const ModelParameters& parameters, const Motion& motion, int s) {
    const RegressorColumns columns = parameters.MakeRegressor().columns();
    const int n = parameters.num_joints();
    const auto m = static_cast<int>(columns.moments.size());
    MomentumRegressor<Dual> regressor(parameters.chain(),
                                      parameters.unknown_lengths());
    MomentumRegressor<Dual>::Vector q(n), qd(n);
    for (int j = 0; j < n; ++j) {
      q[j] = Dual(motion.q(s, j), Eigen::Matrix<double, 1, 1>(motion.qd(s, j)));
      qd[j] =
          Dual(motion.qd(s, j), Eigen::Matrix<double, 1, 1>(motion.qdd(s, j)));
    }
    MomentumRegressor<Dual>::Matrix P_dual(n, m), D_dual(n, m);
    regressor.Evaluate(q, qd, columns.moments, &P_dual, &D_dual);
    P.setZero(n, parameters.size());
    U = D = P;
    for (int c = 0; c < m; ++c) {
      const int to = columns.moment_index[c];
      for (int i = 0; i <= columns.moments[c].block; ++i) {
        P(i, to) = P_dual(i, c).value();
        D(i, to) = D_dual(i, c).value();
        U(i, to) = P_dual(i, c).derivatives()[0] - D(i, to);
      }
    }
    int coulomb = 0;
    for (size_t c = 0; c < columns.terms.size(); ++c) {
      const JointTermColumn& term = columns.terms[c];
      const int j = term.joint, to = columns.term_index[c];
      const double state =
          term.term == JointTerm::kCoulomb ? motion.coulomb(s, coulomb++) : 0;
      P(j, to) = term.P(motion.qd(s, j));
      D(j, to) = term.D(motion.qd(s, j), state);
      U(j, to) = term.Torque(motion.qd(s, j), motion.qdd(s, j), state);
    }
  }
  MatrixXd P, D, U;
};

ModelParameters Model(const Robot& robot, GeometryKnowledge geometry) {
  ModelParameters::Options options;
  options.geometry = geometry;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  options.transitions.assign(robot.links.size(), {CoulombTransition()});
  return ModelParameters(robot, options);
}

double Error(const MatrixXd& value, const MatrixXd& truth) {
  return (value - truth).cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff();
}

void ExpectOneSample(const ModelParameters& parameters, const Motion& motion,
                     int s, const DualNumbers& truth) {
  MatrixXd U, P, D;
  Regressor regressor = parameters.MakeRegressor();
  regressor.Differential(motion.q.row(s), motion.qd.row(s), motion.qdd.row(s),
                         motion.coulomb.row(s), &U);
  regressor.Momentum(motion.q.row(s), motion.qd.row(s), motion.coulomb.row(s),
                     &P, &D);
  EXPECT_LT(Error(U, truth.U), 1e-12);
  EXPECT_LT(Error(P, truth.P), 1e-12);
  EXPECT_LT(Error(D, truth.D), 1e-12);
}

void ExpectDualNumbers(const ModelParameters& parameters, int count,
                       std::mt19937_64* random) {
  const int n = parameters.num_joints();
  const Motion motion(random, count, n, n);
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    const BatchRegressor regressor(parameters, *kernels);
    Rows U(regressor, count), P(regressor, count), D(regressor, count);
    regressor.Differential(motion.columns(), count, U.out(), U.stride);
    regressor.Momentum(motion.columns(), count, P.out(), D.out(), P.stride);
    double worst = 0;
    for (int s = 0; s < count; s += 1 + count / 20) {
      const DualNumbers truth(parameters, motion, s);
      ExpectOneSample(parameters, motion, s, truth);
      for (int i = 0; i < n; ++i) {
        const std::vector<int>& columns = parameters.row_columns(i);
        ASSERT_EQ(regressor.row_size(i), columns.size());
        for (size_t c = 0; c < columns.size(); ++c) {
          const int to = columns[c];
          worst = std::max({worst,
                            std::abs(U(i, s, c) - truth.U(i, to)) /
                                truth.U.cwiseAbs().maxCoeff(),
                            std::abs(P(i, s, c) - truth.P(i, to)) /
                                truth.P.cwiseAbs().maxCoeff(),
                            std::abs(D(i, s, c) - truth.D(i, to)) /
                                truth.D.cwiseAbs().maxCoeff()});
        }
      }
    }
    EXPECT_LT(worst, 1e-12);
    for (const Rows* rows : {&U, &P, &D}) rows->ExpectMarginUntouched();
  }
}

const int kCounts[] = {1, 7, 8, 257};

TEST(BatchRegressor, GivesTheModelParametersColumns) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 36; ++trial) {
    const int n = 1 + trial % 12;
    SCOPED_TRACE(trial);
    const Robot robot = RandomArm(n, &random);
    ExpectDualNumbers(Model(robot, GeometryKnowledge::kKnown),
                      kCounts[trial % 4], &random);
  }
}

TEST(BatchRegressor, GivesColumnsOfUnknownLengths) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    const Robot robot = RandomArm(1 + trial % 5, &random);
    ExpectDualNumbers(Model(robot, GeometryKnowledge::kAllLengths),
                      kCounts[trial % 4], &random);
  }
}

Eigen::Isometry3d RandomPose(std::mt19937_64* random) {
  Eigen::Isometry3d X(RotationFromRpy(UniformVector(random, 3, -3, 3)));
  X.translation() = UniformVector(random, 3, -1, 1);
  return X;
}

// Joints anywhere, along the z axes of their links' frames, along others of
// them, or anyhow.
Robot ArmWithFrames(int n, int trial, std::mt19937_64* random) {
  Robot robot = RandomArm(n, random);
  SetRandomInertials(random, &robot);
  for (Link& link : robot.links) {
    link.X_PF = RandomPose(random);
    link.X_ML.setIdentity();
    if (trial % 3 == 1) {
      const double roll = trial % 2 * M_PI_2;
      link.X_ML.linear() = RotationFromRpy({roll, M_PI_2, 0});
    }
    if (trial % 3 == 2) link.X_ML = RandomPose(random);
  }
  return robot;
}

// Columns of the links' own parameters: the torque is linear in them, so each
// is Newton-Euler with a unit of one of them; P and D are LinkRegressor's sums.
TEST(BatchRegressor, GivesTheLinksColumns) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 24; ++trial) {
    SCOPED_TRACE(trial);
    const int n = 1 + trial % 7, count = kCounts[trial % 4], s = count / 2;
    const Robot robot = ArmWithFrames(n, trial, &random);
    const Motion motion(&random, count, n, 0);
    const VectorXd q = motion.q.row(s), qd = motion.qd.row(s),
                   qdd = motion.qdd.row(s);
    MatrixXd U_true(n, 10 * n), P_true = U_true, D_true = U_true;
    LinkRegressor links(robot);
    for (int c = 0; c < 10 * n; ++c) {
      Robot unit = robot;
      for (Link& link : unit.links) link.inertial = {};
      unit.links[c / 10].inertial =
          InertialParameters::FromVector(Vector10d::Unit(c % 10));
      U_true.col(c) = InverseDynamics(unit, q, qd, qdd);
      VectorXd P, D;
      links.Momentum(q, qd, VectorXd::Unit(10 * n, c), &P, &D);
      P_true.col(c) = P;
      D_true.col(c) = D;
    }
    for (const simd::Kernels* kernels : simd::AvailableKernels()) {
      SCOPED_TRACE(kernels->instruction_set);
      const BatchRegressor regressor(robot, *kernels);
      Rows U(regressor, count), P(regressor, count), D(regressor, count);
      regressor.Differential(motion.columns(), count, U.out(), U.stride);
      regressor.Momentum(motion.columns(), count, P.out(), D.out(), P.stride);
      double worst = 0;
      for (int i = 0; i < n; ++i) {
        ASSERT_EQ(regressor.row_size(i), 10 * (n - i));
        for (int c = 0; c < 10 * (n - i); ++c) {
          const int to = 10 * i + c;
          worst = std::max({worst, std::abs(U(i, s, c) - U_true(i, to)),
                            std::abs(P(i, s, c) - P_true(i, to)),
                            std::abs(D(i, s, c) - D_true(i, to))});
        }
      }
      EXPECT_LT(worst, 1e-12 * U_true.cwiseAbs().maxCoeff());
      for (const Rows* rows : {&U, &P, &D}) rows->ExpectMarginUntouched();
    }
  }
}

TEST(BatchInverseDynamics, IsInverseDynamics) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 36; ++trial) {
    SCOPED_TRACE(trial);
    const int n = 1 + trial % 12, count = kCounts[trial % 4];
    const Robot robot = ArmWithFrames(n, trial, &random);
    const Motion motion(&random, count, n, 0);
    for (const simd::Kernels* kernels : simd::AvailableKernels()) {
      SCOPED_TRACE(kernels->instruction_set);
      MatrixXd tau = MatrixXd::Constant(count + 1, n, 12345);
      std::vector<double*> columns;
      for (int j = 0; j < n; ++j) columns.push_back(tau.col(j).data());
      BatchInverseDynamics(robot, *kernels)
          .Torque(motion.columns(), count, columns.data());
      EXPECT_TRUE((tau.row(count).array() == 12345).all());
      for (int s = 0; s < count; s += 1 + count / 20) {
        const VectorXd expected = InverseDynamics(
            robot, motion.q.row(s), motion.qd.row(s), motion.qdd.row(s));
        EXPECT_LT((tau.row(s).transpose() - expected).norm(),
                  1e-12 * expected.norm());
      }
    }
  }
}

}  // namespace
}  // namespace armcal
