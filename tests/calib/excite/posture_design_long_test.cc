#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calib/excite/posture_design.h"
#include "tests/calib/excite/rated_arms.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::posture_design_long_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class RatedPostures : public testing::TestWithParam<const char*> {
 protected:
  RatedPostures() : robot_(RatedArm(GetParam())) {
    const int n = robot_.num_joints();
    options_.lower = options_.upper = VectorXd(n);
    for (int j = 0; j < n; ++j) {
      options_.lower[j] = std::max(-M_PI, robot_.links[j].joint.lower);
      options_.upper[j] = std::min(M_PI, robot_.links[j].joint.upper);
    }
  }

  MatrixXd Random(int count, std::mt19937_64* random) const {
    const int n = robot_.num_joints();
    MatrixXd q(count, n);
    for (int j = 0; j < n; ++j) {
      q.col(j) =
          UniformVector(random, count, options_.lower[j], options_.upper[j]);
    }
    return q;
  }
  static double LogDet(const MatrixXd& M) {
    return 2 * M.llt().matrixLLT().diagonal().array().log().sum();
  }
  static MatrixXd Sum(const std::vector<MatrixXd>& rows) {
    MatrixXd M = MatrixXd::Zero(rows[0].cols(), rows[0].cols());
    for (const MatrixXd& row : rows) M += row.transpose() * row;
    return M;
  }
  double OfRandom(int count) const {
    std::mt19937_64 random(5);
    double sum = 0;
    constexpr int kDraws = 10;
    for (int k = 0; k < kDraws; ++k) {
      sum += LogDet(
          Sum(PostureEquations(robot_, options_, Random(count, &random))));
    }
    return sum / kDraws;
  }
  // How many random postures have this log determinant.
  double AsManyRandom(double log_det, double unknowns) const {
    double count = 20;
    for (int k = 0; k < 12; ++k) {
      const int whole = static_cast<int>(std::lround(count));
      count = whole * std::exp((log_det - OfRandom(whole)) / unknowns);
    }
    return count;
  }

  Robot robot_;
  PostureOptions options_;
};

INSTANTIATE_TEST_SUITE_P(Arms, RatedPostures,
                         testing::Values("puma", "ur5", "panda"));

// No choice of 20 can do much better than the one that is made: weights on 3000
// postures are raised in proportion to what each still tells (Silvey,
// Titterington and Torsney 1978), and Kiefer's and Wolfowitz' theorem bounds
// what is left. Random postures are near to optimal for what is a sum of sines
// of the joints: as good as 60 of them 20 cannot be.
TEST_P(RatedPostures, AreNearWhatIsPossible) {
  const PostureDesign design = DesignPostures(robot_, options_);
  const double chosen =
      LogDet(Sum(PostureEquations(robot_, options_, design.q)));
  std::mt19937_64 random(9);
  const std::vector<MatrixXd> rows =
      PostureEquations(robot_, options_, Random(3000, &random));
  const auto unknowns = static_cast<double>(rows[0].cols());
  VectorXd weight = VectorXd::Constant(3000, 1. / 3000), tells(3000);
  double bound = 0;
  for (int round = 0; round < 150; ++round) {
    MatrixXd M = MatrixXd::Zero(rows[0].cols(), rows[0].cols());
    for (size_t k = 0; k < rows.size(); ++k) {
      M += weight[static_cast<long>(k)] * rows[k].transpose() * rows[k];
    }
    const Eigen::LLT<MatrixXd> factor(M);
    for (size_t k = 0; k < rows.size(); ++k) {
      tells[static_cast<long>(k)] =
          factor.matrixL().solve(rows[k].transpose()).squaredNorm();
    }
    bound = LogDet(20 * M) + tells.maxCoeff() - unknowns;
    weight = weight.cwiseProduct(tells) / unknowns;
  }
  const double as_many = AsManyRandom(chosen, unknowns);
  const double at_most = AsManyRandom(bound, unknowns);
  std::printf(
      "%s: 20 chosen postures tell as much as %.1f random ones; no 20 "
      "tell more than %.1f\n",
      GetParam(), as_many, at_most);
  EXPECT_GT(as_many, .85 * at_most);
  EXPECT_LT(at_most, 60);
}

}  // namespace armcal::posture_design_long_test
