#include "problems/torque_factor_residual.h"

#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include "problems/inertial_coordinates.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::torque_factor_residual_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Sizes {
  int rows, links, terms, geometry;
};
const Sizes kSizes[] = {
    {27, 2, 4, 3}, {24, 2, 4, 0}, {23, 2, 0, 3}, {10, 1, 0, 0}, {5, 1, 2, 1}};

struct Problem {
  explicit Problem(const Sizes& s) {
    const int columns = 10 * s.links + s.terms + s.geometry;
    R.resize(s.rows, columns);
    for (double& x : R.reshaped()) x = Uniform(&random, -1, 1);
    z = UniformVector(&random, s.rows, -1, 1);
    x.resize(columns);
    for (int i = 0; i < s.links; ++i) {
      blocks.push_back(UniformVector(&random, 10, -.7, .7));
      InertialFromLogCholesky(blocks.back().data(), x.data() + 10 * i);
    }
    if (s.terms > 0) {
      blocks.push_back(UniformVector(&random, s.terms, -1, 1));
      x.segment(10 * s.links, s.terms) = blocks.back();
    }
    if (s.geometry > 0) {
      blocks.push_back(UniformVector(&random, s.geometry, -1, 1));
      x.tail(s.geometry) = blocks.back();
    }
    for (const VectorXd& block : blocks) parameters.push_back(block.data());
  }
  std::mt19937_64 random{3};
  MatrixXd R;
  VectorXd z, x;
  std::vector<VectorXd> blocks;
  std::vector<const double*> parameters;
};

TEST(TorqueFactorResidual, IsTheDenseProduct) {
  for (const Sizes& s : kSizes) {
    const Problem p(s);
    const TorqueFactorResidual cost(p.R, p.z, s.links, {s.terms, s.geometry});
    ASSERT_EQ(cost.num_residuals(), s.rows);
    ASSERT_EQ(cost.parameter_block_sizes().size(), p.blocks.size());
    for (size_t k = 0; k < p.blocks.size(); ++k) {
      EXPECT_EQ(cost.parameter_block_sizes()[k], p.blocks[k].size());
    }
    VectorXd r(s.rows);
    ASSERT_TRUE(cost.Evaluate(p.parameters.data(), r.data(), nullptr));
    EXPECT_LT((r - (p.R * p.x - p.z)).norm(), 1e-12);
  }
}

TEST(TorqueFactorResidual, GradientIsRight) {
  const std::vector<const ceres::Manifold*>* no_manifolds = nullptr;
  for (const Sizes& s : kSizes) {
    const Problem p(s);
    const TorqueFactorResidual cost(p.R, p.z, s.links, {s.terms, s.geometry});
    ceres::NumericDiffOptions options;
    options.ridders_relative_initial_step_size = 1e-3;
    ceres::GradientChecker checker(&cost, no_manifolds, options);
    ceres::GradientChecker::ProbeResults results;
    EXPECT_TRUE(checker.Probe(p.parameters.data(), 1e-7, &results))
        << results.error_log;
  }
}

// Ceres takes false for a step that went too far, and tries a shorter one.
TEST(TorqueFactorResidual, OverflowIsRefused) {
  Problem p(kSizes[0]);
  const TorqueFactorResidual cost(p.R, p.z, 2, {4, 3});
  p.blocks[1][2] = 400;
  VectorXd r(27);
  EXPECT_FALSE(cost.Evaluate(p.parameters.data(), r.data(), nullptr));
}

}  // namespace armcal::torque_factor_residual_test
