#include "model/dynamics/batch_regressor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/dynamics/inverse_dynamics.h"
#include "model/dynamics/link_regressor.h"
#include "tests/model/dynamics/dual_regressor.h"

namespace armcal::batch_regressor_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rows of samples per joint, as a BatchRegressor writes them, with a margin
// that it must not write to.
class Rows {
 public:
  Rows(const BatchRegressor& regressor, int count) : stride(count + 3) {
    for (int i = 0; i < regressor.num_joints(); ++i) {
      values_.push_back(
          MatrixXd::Constant(stride, regressor.row_size(i) + 1, kUntouched));
    }
    for (MatrixXd& rows : values_) pointers_.push_back(rows.data());
  }
  const long stride;
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
  std::vector<MatrixXd> values_;
  std::vector<double*> pointers_;
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

void ExpectOneSample(const ModelParameters& parameters,
                     const RandomMotion& motion, int s,
                     const DualRegressor& truth) {
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

void ExpectDualRegressor(const ModelParameters& parameters, int count,
                         std::mt19937_64* random) {
  const int n = parameters.num_joints();
  const RandomMotion motion(random, count, n, n);
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    const BatchRegressor regressor(parameters, *kernels);
    Rows U(regressor, count), P(regressor, count), D(regressor, count);
    regressor.Differential(motion.columns(), count, U.out(), U.stride);
    regressor.Momentum(motion.columns(), count, P.out(), D.out(), P.stride);
    double worst = 0;
    for (int s = 0; s < count; s += 1 + count / 20) {
      const DualRegressor truth(parameters, motion, s);
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

TEST(BatchRegressor, GivesTheModelParametersColumns) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 36; ++trial) {
    const int n = 1 + trial % 12;
    SCOPED_TRACE(trial);
    const Robot robot = RandomArm(n, &random);
    ExpectDualRegressor(Model(robot, GeometryKnowledge::kKnown),
                        kCounts[trial % 4], &random);
  }
}

TEST(BatchRegressor, GivesColumnsOfUnknownLengths) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    const Robot robot = RandomArm(1 + trial % 5, &random);
    ExpectDualRegressor(Model(robot, GeometryKnowledge::kAllLengths),
                        kCounts[trial % 4], &random);
  }
}

// Columns of the links' own parameters: the torque is linear in them, so each
// is Newton-Euler with a unit of one of them; P and D are LinkRegressor's sums.
TEST(BatchRegressor, GivesTheLinksColumns) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 24; ++trial) {
    SCOPED_TRACE(trial);
    const int n = 1 + trial % 7, count = kCounts[trial % 4], s = count / 2;
    const Robot robot = ArmWithFrames(n, trial, &random);
    const RandomMotion motion(&random, count, n, 0);
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

TEST(BatchRegressor, CuttingMakesNoDifference) {
  std::mt19937_64 random(5);
  const int n = 6, count = 41;
  const ModelParameters model =
      Model(RandomArm(n, &random), GeometryKnowledge::kKnown);
  const RandomMotion m(&random, count, n, n);
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    const BatchRegressor regressor(model, *kernels);
    Rows whole(regressor, count), pieces(regressor, count);
    regressor.Differential(m.columns(), count, whole.out(), whole.stride);
    for (int first = 0, size = 1; first < count; first += size, size += 2) {
      size = std::min(size, count - first);
      std::vector<double*> out(pieces.out(), pieces.out() + n);
      for (double*& rows : out) rows += first;
      regressor.Differential({m.q, m.qd, m.qdd, m.coulomb, first}, size,
                             out.data(), pieces.stride);
    }
    for (int i = 0; i < n; ++i) {
      for (int c = 0; c < regressor.row_size(i); ++c) {
        for (int s = 0; s < count; ++s) {
          ASSERT_EQ(whole(i, s, c), pieces(i, s, c));
        }
      }
    }
  }
}

}  // namespace armcal::batch_regressor_test
